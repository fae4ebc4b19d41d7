//! Fixed points of known maps.

use super::*;
use crate::engine::ray::Anderson;

/// `x -> b + A x` with the eigenvalues 0.9 and, for all else, 0.3 down to 0; a different channel each.
fn image(light: &[Rgb]) -> Vec<Rgb> {
    let n = light.len();
    let mean = light.iter().copied().sum::<Rgb>() / n as f64;
    let one = |k: usize| {
        let share = 0.3 * k as f64 / n as f64;
        Rgb::new(1.0, 2.0, 0.0) + mean * Rgb::new(0.9, 0.6, 0.0) + (light[k] - mean) * share
    };
    (0..n).map(one).collect()
}

/// Sweeps until nothing changes by more than 1e-9, and the light then.
fn settled(mut next: impl FnMut(&[Rgb], Vec<Rgb>) -> Vec<Rgb>) -> (usize, Vec<Rgb>) {
    let mut light: Vec<Rgb> = (0..100).map(|k| Rgb::grey(f64::from(k % 7))).collect();
    for sweep in 1..1000 {
        let now = image(&light);
        let change = now.iter().zip(&light).map(|(&a, &b)| (a - b).max_channel().abs());
        if change.fold(0.0, f64::max) < 1e-9 {
            return (sweep, now);
        }
        light = next(&light, now);
    }
    panic!("it does not settle");
}

#[test]
fn it_settles_where_plain_sweeps_do_and_sooner() {
    let (slow, plain) = settled(|_, image| image);
    let mut anderson = Anderson::new();
    let (fast, found) = settled(|light, image| anderson.next(light, image, &[1.0; 100]));
    // 0.9^n comes to 1e-9 after 200 sweeps; along three directions at once it takes a few rounds.
    assert!(slow > 150 && fast < 25, "{slow} {fast}");
    for (a, b) in plain.iter().zip(&found) {
        // What is left is the last change times 0.9 / 0.1.
        assert!((0..3).all(|c| (a.0[c] - b.0[c]).abs() < 2e-8), "{a:?} {b:?}");
    }
}

#[test]
fn what_does_not_change_stays() {
    let mut anderson = Anderson::new();
    let light = vec![Rgb::new(3.0, 0.0, 1.0); 10];
    for _ in 0..5 {
        assert_eq!(anderson.next(&light, light.clone(), &[1.0; 10]), light);
    }
}
