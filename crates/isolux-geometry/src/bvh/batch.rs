//! Many rays at a time, several of them in flight: while one waits for memory or for the result of
//! an instruction, others go on.
#![allow(unsafe_code, reason = "vector instructions, reached only where the processor has them")]

use super::local::Local;
use super::traverse::{Constants, Lanes, Query, Stack, Walk};
use super::triangle_test::Shear;
use super::wide::WideTree;
use crate::{Point, Ray};
use std::iter::Enumerate;
use std::slice::Iter;

/// Rays in flight.
const IN_FLIGHT: usize = 16;

/// Answers about many rays, in any order: `tell` is given the place of the ray and what was found.
///
/// # Safety
/// The processor has the instructions of `L`.
#[inline(always)]
pub(super) unsafe fn trace_many<const W: usize, L: Lanes<W>, Q: Query>(
    tree: &WideTree<W>,
    (rays, kernel_origin): (&[Ray], Point),
    mut tell: impl FnMut(usize, Q::Answer),
) {
    let mut waiting = rays.iter().enumerate();
    let mut stacks = [const { Stack::<W>::new() }; IN_FLIGHT];
    let mut walks = [const { None }; IN_FLIGHT];
    let mut in_flight = 0;
    for walk in &mut walks {
        *walk = depart::<W, Q>(tree, kernel_origin, &mut waiting, &mut tell);
        in_flight += usize::from(walk.is_some());
    }
    while in_flight > 0 {
        for (slot, stack) in walks.iter_mut().zip(&mut stacks) {
            let Some((place, constants, walk)) = slot else { continue };
            // SAFETY: as the caller says.
            unsafe {
                if walk.step::<W, L>(tree, constants, stack) {
                    L::prefetch(tree, walk.next());
                    continue;
                }
            }
            tell(*place, walk.answer());
            *slot = depart(tree, kernel_origin, &mut waiting, &mut tell);
            in_flight -= usize::from(slot.is_none());
        }
    }
}

/// The next ray that can meet anything.
#[inline(always)]
fn depart<const W: usize, Q: Query>(
    tree: &WideTree<W>,
    kernel_origin: Point,
    waiting: &mut Enumerate<Iter<'_, Ray>>,
    tell: &mut impl FnMut(usize, Q::Answer),
) -> Option<(usize, Constants, Walk<Q>)> {
    for (place, ray) in waiting {
        let ray = &Local::of(ray, kernel_origin);
        match tree.root.zip(Shear::new(ray)) {
            Some((root, shear)) => {
                return Some((
                    place,
                    Constants::new(ray, shear, &tree.bounds),
                    Walk::new(root, Q::new(ray, &shear)),
                ));
            }
            None => tell(place, Q::NOTHING),
        }
    }
    None
}
