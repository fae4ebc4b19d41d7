//! From the flags of a picture to a picture.

use crate::appearance::{ExposureChoice, ProfileChoice, WhiteChoice};
use crate::failure::Failure;
use crate::flags::{LookFlags, ToneName};
use isolux::map::IlluminationMap;
use isolux::scene::Scene;
use isolux_formats::Problem;
use isolux_formats::map_glb::Preview;
use isolux_view::{
    Contours, Development, Exposure, FalseColour, LuminanceImage, MAX_ICC_BYTES, MonitorProfile,
    Picture, Scale, ToneOperator, WhiteAdaptation, colour_of_light, develop, false_colour,
};
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// How views are shown.
pub(crate) struct Look {
    picture: Box<Development>,
    chart: FalseColour,
    exposure: ExposureChoice,
    white: WhiteChoice,
}

impl Look {
    /// The look that is asked for, and what is wrong with it before minutes are spent on a view.
    pub(crate) fn of(flags: &LookFlags) -> Result<Self, Failure> {
        let default = Development::default();
        let picture = Development {
            tone: tone(flags)?,
            display_white_cd_m2: flags.display_white.unwrap_or(default.display_white_cd_m2),
            profile: profile(&flags.profile)?,
            ..default
        };
        let (exposure, white) = (flags.exposure, flags.white);
        Ok(Self { picture: Box::new(picture), chart: chart(flags)?, exposure, white })
    }

    /// The usual look, with contour lines on charts.
    pub(crate) fn usual(scene: &Scene) -> Self {
        let chart = FalseColour { contours: Some(Contours::AtTicks), ..FalseColour::default() };
        let exposure = ExposureChoice::Of(Exposure::Automatic);
        let look = Self { picture: Box::default(), chart, exposure, white: WhiteChoice::Light };
        look.of_scene(scene, None)
    }

    /// The same for views of a scene. `--exposure map` exposes them as viewers show the map itself, so that those of all cameras are
    /// alike; Reinhard's operator has its white there, too.
    pub(crate) fn of_scene(mut self, scene: &Scene, map: Option<&IlluminationMap>) -> Self {
        let how = &mut self.picture;
        how.white = match self.white {
            WhiteChoice::Light => {
                colour_of_light(scene).map_or(WhiteAdaptation::None, WhiteAdaptation::Nearly)
            }
            WhiteChoice::Of(white) => white,
        };
        how.exposure = match (self.exposure, map) {
            (ExposureChoice::Of(exposure), _) => exposure,
            (ExposureChoice::Map, None) => Exposure::Automatic,
            (ExposureChoice::Map, Some(map)) => {
                let preview = Preview::automatic(scene, map);
                match &mut how.tone {
                    ToneOperator::Filmic => Preview::adaptation_cd_m2(scene, map)
                        .map_or(Exposure::Automatic, Exposure::GreyCdM2),
                    ToneOperator::Reinhard { white } => {
                        *white = preview.exposure_m2_cd * preview.white_cd_m2;
                        Exposure::WhiteCdM2(1.0 / preview.exposure_m2_cd)
                    }
                    _ => Exposure::WhiteCdM2(1.0 / preview.exposure_m2_cd),
                }
            }
        };
        self
    }

    /// How pictures are developed.
    pub(crate) fn development(&self) -> &Development {
        &self.picture
    }

    /// The picture of a view.
    pub(crate) fn picture(&self, view: &LuminanceImage) -> Result<Picture, Failure> {
        develop(view, &self.picture).map_err(Failure::bad_input)
    }

    /// The chart of a view.
    pub(crate) fn chart(&self, view: &LuminanceImage) -> Result<Picture, Failure> {
        false_colour(view, &self.chart).map_err(Failure::bad_input)
    }

    /// The display that pictures are for; charts are for any.
    pub(crate) fn profile(&self, is_picture: bool) -> &str {
        if is_picture { self.picture.profile.name() } else { "sRGB" }
    }
}

fn chart(flags: &LookFlags) -> Result<FalseColour, Failure> {
    if let (Some((low, _)), true) = (flags.limits, flags.logarithmic)
        && low <= 0.0
    {
        return Err(Failure::bad_input(format!(
            "--limits {low}: a logarithmic scale has no zero; start above it, as 1:1000"
        )));
    }
    Ok(FalseColour {
        limits: flags.limits,
        contours: flags.contours.then_some(Contours::AtTicks),
        scale: if flags.logarithmic { Scale::Logarithmic } else { Scale::Linear },
        ..FalseColour::default()
    })
}

fn tone(flags: &LookFlags) -> Result<ToneOperator, Failure> {
    let only = |flag: &str, given: Option<f64>, tones: &[ToneName], names: &str| match given {
        Some(_) if !tones.contains(&flags.tone) => Err(Failure::bad_input(format!(
            "{flag}: other tone operators than {names} have none; add --tone {names}, or leave it out"
        ))),
        _ => Ok(()),
    };
    only("--brightness", flags.brightness, &[ToneName::Linear], "linear")?;
    only("--contrast", flags.contrast, &[ToneName::Linear], "linear")?;
    let for_eyes = [ToneName::Ward, ToneName::TumblinRushmeier];
    only("--display-white", flags.display_white, &for_eyes, "ward or tumblin-rushmeier")?;
    Ok(match flags.tone {
        ToneName::Linear => ToneOperator::Linear {
            brightness: flags.brightness.unwrap_or(0.0),
            contrast: flags.contrast.unwrap_or(1.0),
        },
        ToneName::Filmic => ToneOperator::Filmic,
        ToneName::Reinhard => ToneOperator::REINHARD,
        ToneName::Hable => ToneOperator::Hable,
        ToneName::Ward => ToneOperator::Ward,
        ToneName::TumblinRushmeier => ToneOperator::TumblinRushmeier,
    })
}

fn profile(choice: &ProfileChoice) -> Result<MonitorProfile, Failure> {
    match choice {
        ProfileChoice::Srgb => Ok(MonitorProfile::srgb()),
        ProfileChoice::DisplayP3 => Ok(MonitorProfile::display_p3()),
        ProfileChoice::File(path) => read_profile(path),
    }
}

fn read_profile(path: &Path) -> Result<MonitorProfile, Failure> {
    let unreadable = |e| Failure::bad_input(Problem::unreadable(path, &e));
    let about = std::fs::metadata(path).map_err(|e| match e.kind() {
        std::io::ErrorKind::NotFound => Failure::bad_input(format!(
            "--profile {}: does not exist; give srgb, display-p3, or the path of an ICC file",
            path.display()
        )),
        _ => unreadable(e),
    })?;
    if !about.is_file() {
        let what = Problem::new(path, "", "is not a regular file", "name an ICC file");
        return Err(Failure::bad_input(what));
    }
    let mut bytes = Vec::new();
    // The profile itself refuses what is one byte too long.
    let most = MAX_ICC_BYTES as u64 + 1;
    File::open(path).and_then(|f| f.take(most).read_to_end(&mut bytes)).map_err(unreadable)?;
    MonitorProfile::from_icc(&bytes)
        .map_err(|problem| Failure::bad_input(format!("{}: {problem}", path.display())))
}
