//! How far maps are to be trusted, by what they are found to be.

use super::errors::{check_sums, room, small_plan};
use super::trusting::errors;
use super::*;
use crate::engine::judge::{InterpolationErrors, Verdict, check_points};
use crate::engine::light::Lighting;
use crate::engine::mesh::{Trust, TrustLevels, WorstElements};
use crate::map::Accuracy;

/// A map whose error grows with trust, by a tenth of it.
fn by(trust: Trust) -> Verdict {
    let reached = 0.1 * trust.up_to_lx().min(10.0);
    let (statistical, discretization, caustics, bias) = (0.0, reached, 0.0, 0.0);
    let interpolated = reached;
    let accuracy = Accuracy { reached, statistical, discretization, caustics, bias, interpolated };
    Verdict { trust, errors: InterpolationErrors::default(), accuracy: Some(accuracy) }
}

/// Of elements that err by 8, 4, 2 and 1 lx, where readers trust those up to so much.
fn trusts(foreseen_lx: f64) -> TrustLevels {
    let elements = errors(&[(1.0, 8.0), (1.0, 4.0), (1.0, 2.0), (1.0, 1.0)]);
    TrustLevels::of(&WorstElements::of(&elements), foreseen_lx)
}

#[test]
fn readers_trust_as_much_as_an_accuracy_leaves() {
    let trust = |goal: f64| Verdict::for_goal(goal, trusts(f64::INFINITY), by).trust.up_to_lx();
    // What was foreseen will do, or less.
    assert_eq!(trust(1.1), f64::INFINITY);
    assert_eq!(trust(0.9), 6.0);
    assert_eq!(trust(0.4), 3.0);
    // Where none will do, it is the least.
    assert_eq!(trust(0.01), 3.0);
}

#[test]
fn all_but_gaps_are_trusted_where_that_is_enough_and_reaches_the_goal() {
    let trust = |goal: f64, is_enough: bool| {
        let judged = Verdict::for_goal(goal, trusts(6.0), by);
        judged.or_all_but_gaps(goal, |_| is_enough, by).trust
    };
    // An error of 1 with all of them, of 0.6 with those foreseen.
    assert_eq!(trust(1.1, true), Trust::AllButGaps);
    assert_eq!(trust(1.1, false), Trust::UpTo(6.0));
    assert_eq!(trust(0.7, true), Trust::UpTo(6.0));
    // A goal that is missed anyway leaves readers with the least.
    assert_eq!(trust(0.05, true), Trust::UpTo(1.5));
}

#[test]
fn gathering_is_worth_while_where_interpolation_errs_by_more_than_the_map() {
    let scene = room();
    let lighting = Lighting::new(&scene);
    let plan = small_plan(&scene, &lighting);
    let points = check_points::draw(&plan, 0, Key::new(2));
    let is_worth_while = |error: f64, trust: Trust| {
        let sums = check_sums(&points, &plan, |_| error, 0.0);
        check_points::is_gathering_worth_while(&sums, &points, trust, 1.0)
    };
    // Half as much again as the squared error of the map is allowed.
    assert!(!is_worth_while(1.22, plan.trust()));
    assert!(is_worth_while(1.23, plan.trust()));
    // Where nothing is gathered anyway no error makes it so.
    assert!(!is_worth_while(5.0, Trust::AllButGaps));
}
