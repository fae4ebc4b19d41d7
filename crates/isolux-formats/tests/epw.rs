//! Weather files.

#![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

use isolux_formats::epw::{Hour, Weather, parse};
use std::path::Path;

const HEAD: &str = "LOCATION,Berlin,BE,DEU,Test,103840,52.47,13.40,1.0,49.0\r\nCOMMENTS 1,\"a, b\"\r\nDATA PERIODS,1,1,Data,Sunday,1/1,12/31\r\n";

fn hour(month: u32, day: u32, hour: u32, columns: &str) -> String {
    format!("2001,{month},{day},{hour},60,?9?9,20.5,11.2,50,101325,0,0,300,{columns}\r\n")
}

fn read(hours: &str) -> Weather {
    parse(format!("{HEAD}{hours}").as_bytes(), Path::new("a.epw")).unwrap().value
}

fn refused(text: &str) -> String {
    parse(text.as_bytes(), Path::new("a.epw")).unwrap_err().to_string()
}

#[test]
fn a_place_and_its_hours() {
    let weather = read(&hour(6, 21, 12, "600,500,100,65000,52000,13000,0"));
    let place = &weather.place;
    assert_eq!(place.name, "Berlin, BE, DEU");
    let numbers = [place.latitude_deg, place.longitude_deg, place.ahead_h, place.height_m];
    assert_eq!(numbers, [52.47, 13.40, 1.0, 49.0]);
    let expected = Hour {
        month: 6,
        day: 21,
        hour: 12,
        dew_point_c: Some(11.2),
        global_horizontal_w_m2: Some(600.0),
        direct_normal_w_m2: Some(500.0),
        diffuse_horizontal_w_m2: Some(100.0),
        global_horizontal_lx: Some(65_000.0),
        direct_normal_lx: Some(52_000.0),
        diffuse_horizontal_lx: Some(13_000.0),
    };
    assert_eq!(weather.hours, [expected]);
}

/// Of what is missing nothing is known; it is not zero.
#[test]
fn missing_values_are_none() {
    let weather = read(&hour(6, 21, 12, "9999,9999,100,999999,999900,,0"));
    let [hour] = weather.hours[..] else { panic!() };
    assert_eq!((hour.global_horizontal_w_m2, hour.direct_normal_w_m2), (None, None));
    assert_eq!(hour.diffuse_horizontal_w_m2, Some(100.0));
    assert_eq!(
        (hour.global_horizontal_lx, hour.direct_normal_lx, hour.diffuse_horizontal_lx),
        (None, None, None)
    );
    assert_eq!(weather.at(6, 21, 11.5), None);
}

#[test]
fn weather_is_linear_between_the_middles_of_hours() {
    let hours = hour(6, 21, 12, "0,500,100,0,0,0,0") + &hour(6, 21, 13, "0,700,50,0,0,0,0");
    let weather = read(&hours);
    for (time, direct, diffuse) in
        [(11.5, 500.0, 100.0), (12.0, 600.0, 75.0), (12.25, 650.0, 62.5), (12.5, 700.0, 50.0)]
    {
        let at = weather.at(6, 21, time).unwrap();
        assert_eq!(
            (at.direct_normal_w_m2, at.diffuse_horizontal_w_m2),
            (direct, diffuse),
            "{time}"
        );
    }
    assert_eq!(weather.at(6, 21, 13.0), None);
    assert_eq!(weather.at(6, 22, 12.0), None);
}

#[test]
fn what_is_wrong_has_its_line() {
    let one = |columns: &str| format!("{HEAD}{}", hour(6, 21, 12, columns));
    let good = "600,500,100,0,0,0,0";
    for (text, expected) in [
        ("place Berlin\n".to_owned(), "does not begin with LOCATION"),
        (HEAD.replace("52.47", "95"), "line 1: the latitude is 95"),
        (HEAD.replace("52.47", "north"), "line 1: the latitude is `north`, which is no number"),
        (HEAD.replace("DATA PERIODS", "DATA"), "has no line DATA PERIODS"),
        (HEAD.replace("PERIODS,1,1", "PERIODS,1,4"), "has `4` records an hour"),
        (HEAD.to_owned(), "has no hours"),
        (one("600,500"), "line 4: 15 fields"),
        (one("600,many,100,0,0,0,0"), "line 4: the direct normal irradiance is `many`"),
        (one("600,-5,100,0,0,0,0"), "line 4: the direct normal irradiance is -5"),
        (one("600,5000,100,0,0,0,0"), "line 4: the direct normal irradiance is 5000"),
        (format!("{HEAD}{}", hour(13, 1, 1, good)), "the month is 13"),
        (format!("{HEAD}{}", hour(2, 30, 1, good)), "the day is 30"),
        (format!("{HEAD}{}", hour(2, 1, 25, good)), "the hour is 25"),
        (
            format!("{HEAD}{}{}", hour(6, 21, 12, good), hour(6, 21, 12, good)),
            "line 5: the hour 12 of 6-21 does not come after",
        ),
    ] {
        let found = refused(&text);
        assert!(found.contains(expected), "{expected}: {found}");
    }
}
