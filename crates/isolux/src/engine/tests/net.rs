//! Light gathered on a net.

use crate::engine::IndirectReading;
use crate::engine::net::{Fineness, Net, Wanted};
use crate::sampling::Key;
use crate::units::Rgb;
use std::convert::Infallible;

const SIZE: usize = 48;

/// A chart of so many texels squared, of which several kinds are wanted.
fn net(size: usize, kind: impl Fn([usize; 2]) -> u64) -> Net<'static> {
    net_of(size, kind, Fineness::TEXELS)
}

fn net_of(size: usize, kind: impl Fn([usize; 2]) -> u64, fineness: Fineness) -> Net<'static> {
    let wanted = (0..size * size).map(|number| {
        let at = [number % size, number / size];
        Wanted { number, at, kind: kind(at) }
    });
    Net::new(wanted.collect(), fineness, Box::new(|_, _| true))
}

/// A chart with a wall across it: its first so many columns and the others do not see each other.
fn parted(size: usize, wall: usize) -> Net<'static> {
    let number = |number: usize| Wanted { number, at: [number % size, number / size], kind: 0 };
    let sight = move |a: usize, b: usize| (a % size < wall) == (b % size < wall);
    Net::new((0..size * size).map(number).collect(), Fineness::TEXELS, Box::new(sight))
}

fn reading(lx: f64) -> IndirectReading {
    IndirectReading { lx: Rgb::grey(lx), error_lx: 1.0, noise_lx: 0.0 }
}

/// Gathers this light and continues it: how many texels were gathered, and of all how far off they are, and by how much they
/// say.
fn gathered(
    size: usize,
    mut net: Net<'_>,
    lx: impl Fn([usize; 2]) -> f64,
) -> (usize, Vec<([usize; 2], f64, f64)>) {
    let at = |number: usize| [number % size, number / size];
    let found = net.fill(|numbers, _| -> Result<_, Infallible> {
        Ok(numbers.iter().map(|&number| Some(reading(lx(at(number))))).collect())
    });
    let Ok(()) = found;
    let count = net.filled().filter(|filled| filled.is_gathered).count();
    let of_texel = net.filled().map(|filled| {
        let (at, reading) = (at(filled.number), filled.reading.unwrap());
        (at, reading.lx.luminance() - lx(at), reading.error_lx)
    });
    (count, of_texel.collect())
}

#[test]
fn a_net_cut_short_asks_no_more_and_continues_only_what_it_knows() {
    let lx = |[x, y]: [usize; 2]| 100.0 + 0.1 * x as f64 + 0.05 * y as f64;
    let at = |number: usize| [number % SIZE, number / SIZE];
    // All of the first squares and half of the second.
    let (first, second) = (SIZE * SIZE / 64, SIZE * SIZE / 16 - SIZE * SIZE / 64);
    for left in [first / 2, first, first + second / 2] {
        let mut net = net(SIZE, |_| 0);
        let (mut given, mut is_over) = (0, false);
        let Ok(()) = net.fill(|numbers, _| -> Result<_, Infallible> {
            assert!(!is_over, "asked again");
            let some = &numbers[..numbers.len().min(left - given)];
            given += some.len();
            is_over = some.len() < numbers.len();
            Ok(some.iter().map(|&number| Some(reading(lx(at(number))))).collect())
        });
        assert!(net.is_cut_short());
        assert_eq!(net.filled().filter(|filled| filled.is_gathered).count(), left);
        let known: Vec<(usize, IndirectReading)> =
            net.filled().filter_map(|filled| Some((filled.number, filled.reading?))).collect();
        let is_near = |(number, told): &(usize, IndirectReading)| {
            (told.lx.luminance() - lx(at(*number))).abs() < told.error_lx
        };
        assert!(known.iter().all(is_near));
        // The first squares alone tell a few differences; half of the second tells them for half of all.
        let count = known.len();
        assert!(count >= left && count < SIZE * SIZE, "{left}: {count}");
        assert!(left <= first || count > SIZE * SIZE / 3, "{left}: {count}");
    }
}

#[test]
fn smooth_light_is_gathered_at_one_texel_of_sixteen() {
    // Half a lux from square to square of 4 x 4: the half of an error that is left to be continued.
    let smooth = |[x, y]: [usize; 2]| 100.0 + 0.1 * x as f64 + 0.05 * y as f64;
    let (count, texels) = gathered(SIZE, net(SIZE, |_| 0), smooth);
    // And one in some squares at the rim, if that lies beyond what was gathered.
    assert!((SIZE * SIZE / 16..SIZE * SIZE / 13).contains(&count), "{count}");
    assert!(texels.iter().all(|(_, off, error_lx)| off.abs() < *error_lx));
    // A plane is continued as one, but for its stiffness where texels lie on one side only.
    let inside = texels.iter().filter(|(at, ..)| at.iter().all(|c| (8..SIZE - 8).contains(c)));
    assert!(inside.clone().all(|(_, off, _)| off.abs() < 0.1), "{:?}", inside.collect::<Vec<_>>());
}

#[test]
fn light_that_jumps_is_gathered_there_and_nowhere_else() {
    let jump = |[x, _]: [usize; 2]| if x < 22 { 20.0 } else { 220.0 };
    let (count, texels) = gathered(SIZE, net(SIZE, |_| 0), jump);
    // Beside the jump two squares of 8 at most each way, of six.
    assert!(count < SIZE * SIZE / 2, "{count}");
    for (at, off, error_lx) in texels {
        assert!(off.abs() < 3.0 * error_lx, "{at:?}: {off} of {error_lx}");
        // Sums of shares that make one.
        assert!(!(20..24).contains(&at[0]) || off.abs() < 1e-9, "{at:?}: {off}");
    }
}

#[test]
fn light_that_falls_off_at_a_rim_is_gathered_there() {
    // Charts that end anywhere in a square. What the middles of squares see tells nothing of their rims.
    let (mut outside, mut all) = (0, 0);
    for rim in 8..40 {
        let lx = |at: [usize; 2]| {
            100.0 - 20.0 * at.iter().map(|&c| (c as f64 - rim as f64).exp()).sum::<f64>()
        };
        let (count, texels) = gathered(rim + 1, net(rim + 1, |_| 0), lx);
        for (at, off, error_lx) in &texels {
            assert!(off.abs() < 5.0 * error_lx, "{rim} {at:?}: {off} of {error_lx}");
            outside += usize::from(off.abs() > 1.96 * error_lx);
        }
        all += texels.len();
        // Two squares of 8 along two sides at most, one in sixteen elsewhere.
        let inside = (rim + 1usize).saturating_sub(16).pow(2);
        assert!(count <= texels.len() - inside * 3 / 4, "{rim}: {count} of {}", texels.len());
    }
    assert!(100 * outside < all, "{outside} of {all}");
}

#[test]
fn gaps_and_charts_know_nothing_of_each_other() {
    let is_gap = |at: [usize; 2]| at[1] < 5;
    let kind = |at: [usize; 2]| 2 * u64::from(at[0] >= 30) + u64::from(is_gap(at));
    let lx =
        |at: [usize; 2]| if is_gap(at) { 0.0 } else { 100.0 * (1 + u8::from(at[0] >= 30)) as f64 };
    let (count, texels) = gathered(SIZE, net(SIZE, kind), lx);
    // Squares that a border cuts are more.
    assert!(count < SIZE * SIZE / 10, "{count}");
    // Sums of shares that make one.
    assert!(texels.iter().all(|(_, off, _)| off.abs() < 1e-9));
}

#[test]
fn single_texels_are_gathered() {
    let (count, _) = gathered(SIZE, net(SIZE, |[x, y]| (SIZE * y + x) as u64), |_| 5.0);
    assert_eq!(count, SIZE * SIZE);
}

#[test]
fn pictures_take_wider_squares_and_leave_what_is_not_to_be_seen() {
    let hill = |[x, y]: [usize; 2]| {
        let squared = (x as f64 - 20.0).powi(2) + (y as f64 - 25.0).powi(2);
        100.0 + 50.0 * (-squared / 400.0).exp()
    };
    let (of_texels, _) = gathered(SIZE, net(SIZE, |_| 0), hill);
    let (count, pixels) = gathered(SIZE, net_of(SIZE, |_| 0, Fineness::PIXELS), hill);
    assert!(count < of_texels / 2, "{count} of {of_texels}");
    // Half of what differs from square to square, with two errors to spare.
    let worst = pixels.iter().map(|(_, off, _)| off.abs()).fold(0.0, f64::max);
    assert!(worst < 0.04 * 150.0, "{worst}");
}

/// Readings of 100 lx with a noise of 5 lx.
#[test]
fn pictures_show_little_of_the_noise_of_readings() {
    let key = Key::new(3);
    // Of variance one: the sum of twelve even numbers.
    let normal = |of: Key| (0..12).map(|k| of.with(k).uniform()).sum::<f64>() - 6.0;
    let mut net = net_of(SIZE * 2, |_| 0, Fineness::PIXELS);
    let found = net.fill(|numbers, _| -> Result<_, Infallible> {
        let noisy = |&number: &usize| {
            let lx = 100.0 + 5.0 * normal(key.with(number as u64));
            Some(IndirectReading { lx: Rgb::grey(lx), error_lx: 5.0, noise_lx: 5.0 })
        };
        Ok(numbers.iter().map(noisy).collect())
    });
    let Ok(()) = found;
    let off = net.filled().map(|filled| filled.reading.unwrap().lx.luminance() - 100.0);
    let (count, squared) = off.fold((0, 0.0), |(n, sum), off| (n + 1, sum + off * off));
    let left = (squared / f64::from(count)).sqrt();
    // One of 8 x 8 pixels is gathered. Through twelve of them 2.4 lx are left, through all that lie in nine of the widest squares
    // 1.3: halfway between.
    assert!(left < 1.8, "{left}");
}

#[test]
fn light_is_not_continued_past_what_stands_between() {
    // Down to a strip that no square of 4 x 4 lies in.
    for wall in [22, 24, SIZE - 6, SIZE - 3, SIZE - 1] {
        let room = |[x, _]: [usize; 2]| if x < wall { 500.0 } else { 0.5 };
        let (count, texels) = gathered(SIZE, parted(SIZE, wall), room);
        // Either room is smooth: one texel of sixteen, one more beside the wall, and all of a narrow strip.
        assert!(count < SIZE * SIZE / 16 + 4 * SIZE, "{wall}: {count}");
        for (at, off, _) in texels {
            assert!(off.abs() < 1e-9, "{wall} {at:?}: {off}");
        }
    }
}

/// Readings of 500 and of 0.5 lx, all with a noise of 10 %, at which texels are smoothed.
#[test]
fn noise_is_not_smoothed_past_what_stands_between() {
    let (wall, key) = (22, Key::new(5));
    let mut net = parted(SIZE, wall);
    let found = net.fill(|numbers, _| -> Result<_, Infallible> {
        let noisy = |&number: &usize| {
            let lx = if number % SIZE < wall { 500.0 } else { 0.5 };
            let off = 0.2 * (key.with(number as u64).uniform() - 0.5);
            let lx_there = Rgb::grey(lx * (1.0 + off));
            Some(IndirectReading { lx: lx_there, error_lx: 0.1 * lx, noise_lx: 0.1 * lx })
        };
        Ok(numbers.iter().map(noisy).collect())
    });
    let Ok(()) = found;
    for filled in net.filled() {
        let lx = filled.reading.unwrap().lx.luminance();
        let due = if filled.number % SIZE < wall { 500.0 } else { 0.5 };
        assert!((lx / due - 1.0).abs() < 0.2, "{}: {lx} of {due}", filled.number);
    }
}
