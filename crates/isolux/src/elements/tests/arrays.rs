//! Elements as arrays and back, and arrays from anywhere.

use super::*;
use crate::elements::{ElementArrays, ElementArraysError};

#[test]
fn arrays_come_back_as_they_were() {
    for (name, _, subdivision) in every_kind() {
        let elements = subdivision.elements();
        let back = Elements::from_arrays(&elements.to_arrays());
        assert_eq!(back.as_ref(), Ok(&elements), "{name}");
    }
}

fn arrays() -> ElementArrays {
    let (_, _, subdivision) = every_kind().remove(3);
    subdivision.elements().to_arrays()
}

fn shorten<T>(rows: &mut Vec<T>) {
    rows.truncate(rows.len() - 1);
}

#[test]
fn arrays_that_are_no_elements_are_refused_with_the_reason() {
    type Spoil = fn(&mut ElementArrays);
    let cases: [(&str, Spoil, ElementArraysError); 12] = [
        ("a normal less", |a| shorten(&mut a.normals), ElementArraysError::Lengths("vertices")),
        ("a parent less", |a| shorten(&mut a.parents), ElementArraysError::Lengths("vertices")),
        ("an area less", |a| shorten(&mut a.areas_m2), ElementArraysError::Lengths("vertices")),
        ("a split less", |a| shorten(&mut a.splits), ElementArraysError::Lengths("nodes")),
        ("a place that is none", |a| a.positions[3][1] = f64::NAN, ElementArraysError::Vertex(3)),
        ("an endless place", |a| a.positions[4][0] = f64::INFINITY, ElementArraysError::Vertex(4)),
        ("a normal of zero", |a| a.normals[5] = [0.0; 3], ElementArraysError::Vertex(5)),
        ("a normal that is none", |a| a.normals[0][2] = f64::NAN, ElementArraysError::Vertex(0)),
        (
            "its own parent",
            |a| a.parents[9] = [9, 1],
            ElementArraysError::Index("the parent of a vertex"),
        ),
        (
            "one parent only",
            |a| a.parents[9] = [1, u32::MAX],
            ElementArraysError::Index("the parent of a vertex"),
        ),
        (
            "a far vertex",
            |a| a.nodes[2][1] = u32::MAX,
            ElementArraysError::Index("the vertex of a node"),
        ),
        (
            "a far root",
            |a| a.roots[1][0] = 1 << 30,
            ElementArraysError::Index("the root of a triangle"),
        ),
    ];
    for (name, spoil, expected) in cases {
        let mut spoilt = arrays();
        spoil(&mut spoilt);
        assert_eq!(Elements::from_arrays(&spoilt), Err(expected), "{name}");
    }
}

#[test]
fn areas_that_are_no_numbers_are_refused() {
    for area_m2 in [f64::NAN, f64::INFINITY, -1e-3] {
        let mut spoilt = arrays();
        spoilt.areas_m2[7] = area_m2;
        assert_eq!(Elements::from_arrays(&spoilt), Err(ElementArraysError::Vertex(7)));
    }
}

#[test]
fn no_elements_are_elements() {
    let none = Elements::from_arrays(&ElementArrays::default()).unwrap();
    assert!(none.vertices().is_empty() && none.elements().is_empty());
    assert_eq!(none.locate(0, false, 0.2, 0.2), None);
}

/// Numbers changed at random: refused, or elements that can be walked without harm.
#[test]
fn spoilt_arrays_do_no_harm() {
    let whole = arrays();
    let (mut refused, mut taken) = (0, 0);
    for trial in 0..3000 {
        let key = Key::new(31).with(trial);
        let mut spoilt = whole.clone();
        for k in 0..1 + trial % 3 {
            spoil(&mut spoilt, key.with(k));
        }
        match Elements::from_arrays(&spoilt) {
            Err(_) => refused += 1,
            Ok(elements) => {
                taken += 1;
                let vertices = elements.vertices().len() as u32;
                assert!(elements.elements().iter().flat_map(|e| e.vertices).all(|v| v < vertices));
                for triangle in 0..20 {
                    let place = elements.locate(triangle, false, 0.3, 0.4);
                    assert!(place.is_none_or(|p| p.iter().all(|&(v, _)| v < vertices)));
                }
            }
        }
    }
    assert!(refused > 500 && taken > 100, "{refused} {taken}: the trials try nothing");
}

fn spoil(arrays: &mut ElementArrays, key: Key) {
    let pick = |n: u64, below: usize| (key.with(n).uniform() * below as f64) as usize;
    let small = pick(0, 2 * arrays.nodes.len()) as u32;
    let index = [small, u32::MAX, u32::MAX - 1, 0][pick(1, 4)];
    let at = key.with(2).bits() as usize;
    match pick(3, 6) {
        0 => spoil_row(&mut arrays.nodes, at, index),
        1 => spoil_row(&mut arrays.splits, at, index),
        2 => spoil_row(&mut arrays.splits, at, index % 4),
        3 => spoil_row(&mut arrays.roots, at, index),
        4 => spoil_row(&mut arrays.parents, at, index),
        _ => spoil_row(&mut arrays.positions, at, [f64::NAN, 1e300, -0.0, 7.0][pick(4, 4)]),
    }
}

fn spoil_row<T, const N: usize>(rows: &mut [[T; N]], at: usize, value: T) {
    let row = at % rows.len();
    rows[row][at / rows.len() % N] = value;
}
