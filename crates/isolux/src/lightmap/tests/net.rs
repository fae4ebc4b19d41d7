//! Light gathered on a net.

use crate::engine::IndirectReading;
use crate::lightmap::net::{Light, Net, Step, Wanted};
use crate::lightmap::places::Place;
use crate::units::Rgb;

const SIZE: usize = 48;

/// A chart of so many texels squared, of which two kinds are wanted.
fn net(kind: impl Fn([usize; 2]) -> (u32, bool)) -> Net {
    let wanted = (0..SIZE * SIZE).map(|number| {
        let at = [number % SIZE, number / SIZE];
        Wanted { number, at, kind: kind(at), place: Place { side: 0, at: [0.0; 2] } }
    });
    Net::new(wanted.collect())
}

fn reading(lx: f64) -> IndirectReading {
    IndirectReading { lx: Rgb::grey(lx), error_lx: 1.0, noise_lx: 0.0 }
}

/// Gathers this light and continues it: how many texels were gathered, and of all how far off they are, and by how much they
/// say.
fn gathered(mut net: Net, lx: impl Fn([usize; 2]) -> f64) -> (usize, Vec<([usize; 2], f64, f64)>) {
    for step in Step::ALL.into_iter().map(Some).chain([None]) {
        let chosen = step.map_or_else(|| net.left(), |step| net.chosen(step));
        let found: Vec<_> = chosen.iter().map(|&k| Some(reading(lx(net.wanted[k].at)))).collect();
        net.store(&chosen, &found);
    }
    net.finish();
    let mut count = 0;
    let of_texel = net.wanted.iter().zip(&net.light).map(|(wanted, light)| {
        let reading = match light {
            Light::Gathered(reading, _) => {
                count += 1;
                reading
            }
            Light::Continued(reading) => reading,
            other => panic!("{other:?} at {:?}", wanted.at),
        };
        (wanted.at, reading.lx.luminance() - lx(wanted.at), reading.error_lx)
    });
    let all = of_texel.collect();
    (count, all)
}

#[test]
fn smooth_light_is_gathered_at_one_texel_of_sixteen() {
    // Half a lux from square to square of 4 x 4: the half of an error that is left to be continued.
    let smooth = |[x, y]: [usize; 2]| 100.0 + 0.1 * x as f64 + 0.05 * y as f64;
    let (count, texels) = gathered(net(|_| (0, false)), smooth);
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
    let (count, texels) = gathered(net(|_| (0, false)), jump);
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
        let wanted = (0..=rim).flat_map(|y| (0..=rim).map(move |x| [x, y])).enumerate();
        let place = Place { side: 0, at: [0.0; 2] };
        let wanted = wanted.map(|(number, at)| Wanted { number, at, kind: (0, false), place });
        let (count, texels) = gathered(Net::new(wanted.collect()), lx);
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
    let kind = |at: [usize; 2]| (u32::from(at[0] >= 30), is_gap(at));
    let lx =
        |at: [usize; 2]| if is_gap(at) { 0.0 } else { 100.0 * (1 + u8::from(at[0] >= 30)) as f64 };
    let (count, texels) = gathered(net(kind), lx);
    // Squares that a border cuts are more.
    assert!(count < SIZE * SIZE / 10, "{count}");
    // Sums of shares that make one.
    assert!(texels.iter().all(|(_, off, _)| off.abs() < 1e-9));
}

#[test]
fn single_texels_are_gathered() {
    let (count, _) = gathered(net(|[x, y]| ((SIZE * y + x) as u32, false)), |_| 5.0);
    assert_eq!(count, SIZE * SIZE);
}
