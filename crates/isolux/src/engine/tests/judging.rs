//! How far maps are to be trusted, by what they are found to be.

use super::errors::{check_sums, room, small_plan};
use super::*;
use crate::engine::checks::{self, InterpolationErrors};
use crate::engine::direct::Lighting;
use crate::engine::judged::Judged;
use crate::engine::trust::Trust;
use crate::map::Accuracy;

/// A map whose error grows with trust, by a tenth of it.
fn by(trust: Trust) -> Judged {
    let reached = 0.1 * trust.up_to_lx().min(10.0);
    let (statistical, discretization, caustics, bias) = (0.0, reached, 0.0, 0.0);
    let interpolated = reached;
    let accuracy = Accuracy { reached, statistical, discretization, caustics, bias, interpolated };
    Judged { trust, errors: InterpolationErrors::default(), accuracy: Some(accuracy) }
}

#[test]
fn readers_trust_as_much_as_an_accuracy_leaves() {
    let trust = |goal: f64, foreseen: f64| {
        let judged = Judged::for_goal(goal, Trust::UpTo(foreseen), by);
        judged.trust.up_to_lx()
    };
    // What was foreseen will do, or seven tenths of it, or half, or a third.
    assert_eq!(trust(0.21, 2.0), 2.0);
    assert_eq!(trust(0.19, 2.0), 1.4);
    assert_eq!(trust(0.13, 2.0), 1.0);
    assert_eq!(trust(0.08, 2.0), 0.7);
    // Where none will do, it is the least.
    assert_eq!(trust(0.01, 2.0), 0.7);
    // Where no element was to be left out, none is.
    assert_eq!(trust(0.01, f64::INFINITY), f64::INFINITY);
}

#[test]
fn all_but_gaps_are_trusted_where_that_is_enough_and_reaches_the_goal() {
    let trust = |goal: f64, is_enough: bool| {
        let judged = Judged::for_goal(goal, Trust::UpTo(2.0), by);
        judged.or_all_but_gaps(goal, |_| is_enough, by).trust
    };
    // An error of 1 with all of them, of 0.2 with those foreseen.
    assert_eq!(trust(1.1, true), Trust::AllButGaps);
    assert_eq!(trust(1.1, false), Trust::UpTo(2.0));
    assert_eq!(trust(0.3, true), Trust::UpTo(2.0));
    // A goal that is missed anyway leaves readers with the least.
    assert_eq!(trust(0.05, true), Trust::UpTo(0.7));
}

#[test]
fn gathering_is_worth_while_where_interpolation_errs_by_more_than_the_map() {
    let scene = room();
    let lighting = Lighting::new(&scene);
    let plan = small_plan(&scene, &lighting);
    let points = checks::draw(&plan, 0, Key::new(2));
    let is_worth_while = |error: f64, trust: Trust| {
        let sums = check_sums(&points, &plan, |_| error, 0.0);
        checks::is_gathering_worth_while(&sums, &points, trust, [1.0; 2])
    };
    // Half as much again as the squared error of the map is allowed.
    assert!(!is_worth_while(1.22, plan.trust()));
    assert!(is_worth_while(1.23, plan.trust()));
    // Where nothing is gathered anyway no error makes it so.
    assert!(!is_worth_while(5.0, Trust::AllButGaps));
}
