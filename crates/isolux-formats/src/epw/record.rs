//! A year of weather.

/// A place and its hours.
#[derive(Clone, Debug, PartialEq)]
pub struct Weather {
    /// Where.
    pub place: WeatherPlace,
    /// In the order of the year, without gaps that were not told.
    pub hours: Vec<Hour>,
}

/// The place of a weather file.
#[derive(Clone, Debug, PartialEq)]
pub struct WeatherPlace {
    /// City, region and country, as far as they are written.
    pub name: String,
    /// North of the equator.
    pub latitude_deg: f64,
    /// East of Greenwich.
    pub longitude_deg: f64,
    /// How far clocks are ahead of UTC, without summer time, hours.
    pub ahead_h: f64,
    /// Above the sea.
    pub height_m: f64,
}

/// Means over one hour; `None` where the file has no value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hour {
    /// From 1.
    pub month: u32,
    /// From 1.
    pub day: u32,
    /// The hour that ends so many hours after midnight, from 1 to 24.
    pub hour: u32,
    /// Degrees Celsius.
    pub dew_point_c: Option<f64>,
    /// Irradiance of a horizontal surface by sun and sky, W/m2.
    pub global_horizontal_w_m2: Option<f64>,
    /// Irradiance of a surface that faces the sun, by the sun, W/m2.
    pub direct_normal_w_m2: Option<f64>,
    /// Irradiance of a horizontal surface by the sky, W/m2.
    pub diffuse_horizontal_w_m2: Option<f64>,
    /// Illuminance of a horizontal surface by sun and sky, lx.
    pub global_horizontal_lx: Option<f64>,
    /// Illuminance of a surface that faces the sun, by the sun, lx.
    pub direct_normal_lx: Option<f64>,
    /// Illuminance of a horizontal surface by the sky, lx.
    pub diffuse_horizontal_lx: Option<f64>,
}

/// What the weather is at one moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instant {
    /// Irradiance of a surface that faces the sun, by the sun, W/m2.
    pub direct_normal_w_m2: f64,
    /// Irradiance of a horizontal surface by the sky, W/m2.
    pub diffuse_horizontal_w_m2: f64,
    /// Degrees Celsius.
    pub dew_point_c: Option<f64>,
}

impl Weather {
    /// The weather at so many hours after midnight, linear between the middles of the hours; the year ends where it begins. `None`
    /// where the file has no such hour or no irradiance in it.
    pub fn at(&self, month: u32, day: u32, hours: f64) -> Option<Instant> {
        let whole = hours.floor();
        let is_there = |h: &Hour| (h.month, h.day, f64::from(h.hour)) == (month, day, whole + 1.0);
        let here = self.hours.iter().position(is_there)?;
        let count = self.hours.len();
        // From the middle of an hour to that of the next.
        let late = hours - whole - 0.5;
        let (first, share) = if late < 0.0 { (here + count - 1, 1.0 + late) } else { (here, late) };
        let [one, other] = [first % count, (first + 1) % count].map(|k| &self.hours[k]);
        let between =
            |of: fn(&Hour) -> Option<f64>| Some(of(one)? * (1.0 - share) + of(other)? * share);
        Some(Instant {
            direct_normal_w_m2: between(|h| h.direct_normal_w_m2)?,
            diffuse_horizontal_w_m2: between(|h| h.diffuse_horizontal_w_m2)?,
            dew_point_c: between(|h| h.dew_point_c),
        })
    }
}
