//! Runs as checkpoints: their states, pilots and parts.

use super::{ArrayError, Checkpoint, Draft};
use isolux::engine::{Audited, PilotState, RunIdentity, RunPart, RunState, Segment, Sums};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::io;

/// What a checkpoint is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Kind {
    Run,
    Pilot,
    Part,
}

impl Kind {
    const fn name(self) -> &'static str {
        match self {
            Self::Run => "the state of a run",
            Self::Pilot => "the result of a pilot",
            Self::Part => "a part of a run",
        }
    }
}

#[derive(Deserialize)]
struct AnyKind {
    kind: Kind,
}

/// What stands in front of the sums of a run.
#[derive(Serialize, Deserialize)]
struct OfRun {
    kind: Kind,
    identity: RunIdentity,
    stage: u32,
    rays: u64,
    increments: u64,
    audited: Audited,
    #[serde(default)]
    stayed_coarse: bool,
}

/// What stands in front of the result of a pilot.
#[derive(Serialize, Deserialize)]
struct OfPilot {
    kind: Kind,
    identity: RunIdentity,
    stage: u32,
    rays: u64,
}

/// What stands in front of the sums of a part.
#[derive(Serialize, Deserialize)]
struct OfPart {
    kind: Kind,
    scene: String,
    identity: RunIdentity,
    stage: u32,
    segments: Vec<OfSegment>,
}

#[derive(Serialize, Deserialize)]
struct OfSegment {
    first: u64,
    count: u64,
    rays: u64,
}

/// A part of a run, and its scene as the user named it.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// A path, or the name of a builtin scene.
    pub scene: String,
    /// The increments.
    pub part: RunPart,
}

/// What a checkpoint holds.
pub enum Contents {
    /// The state of a run, without its pilot.
    Run(Box<RunState>),
    /// The result of a pilot.
    Pilot(Box<PilotState>),
    /// A part of a run.
    Part(Box<Part>),
}

/// Whatever a checkpoint holds. The error says what is wrong.
pub fn contents(checkpoint: &Checkpoint) -> Result<Contents, String> {
    match kind(checkpoint)? {
        Kind::Run => state(checkpoint).map(Box::new).map(Contents::Run),
        Kind::Pilot => pilot(checkpoint).map(Box::new).map(Contents::Pilot),
        Kind::Part => part(checkpoint).map(Box::new).map(Contents::Part),
    }
}

/// The state of a run, without its pilot.
pub fn of_state(state: &RunState) -> Draft<'_> {
    let mut draft = with_header(&OfRun {
        kind: Kind::Run,
        identity: state.identity.clone(),
        stage: state.stage,
        rays: state.rays,
        increments: state.increments,
        audited: state.audited.clone(),
        stayed_coarse: state.stayed_coarse,
    });
    let arrays =
        [("receivers", &state.receivers), ("checks", &state.checks), ("given_up", &state.given_up)];
    arrays.iter().for_each(|(name, sums)| push_sums(&mut draft, name, sums, Squares::Kept));
    draft
}

/// The state of a run, without its pilot. The error says what is wrong.
pub fn state(checkpoint: &Checkpoint) -> Result<RunState, String> {
    let header: OfRun = header(checkpoint, Kind::Run)?;
    let sums = |name: &str| sums(checkpoint, name, Squares::Kept);
    Ok(RunState {
        identity: header.identity,
        stage: header.stage,
        rays: header.rays,
        increments: header.increments,
        audited: header.audited,
        stayed_coarse: header.stayed_coarse,
        receivers: sums("receivers")?,
        checks: sums("checks")?,
        given_up: sums("given_up")?,
        pilot: None,
    })
}

/// The result of a pilot. The error says why it cannot be kept.
pub fn of_pilot(pilot: &PilotState) -> Result<Draft<'_>, String> {
    let PilotState { identity, stage, rays, result } = pilot;
    let (identity, stage, rays) = (identity.clone(), *stage, *rays);
    let mut draft = with_header(&OfPilot { kind: Kind::Pilot, identity, stage, rays });
    let bytes = postcard::serialize_with_flavor(result, postcard::ser_flavors::Size::default())
        .map_err(|error| error.to_string())?;
    draft.push_written(RESULT, bytes, |to| {
        postcard::to_io(result, to).map(drop).map_err(io::Error::other)
    });
    Ok(draft)
}

/// The result of a pilot. The error says what is wrong.
pub fn pilot(checkpoint: &Checkpoint) -> Result<PilotState, String> {
    let OfPilot { identity, stage, rays, .. } = header(checkpoint, Kind::Pilot)?;
    let bytes = checkpoint.array(RESULT).map_err(|error| error.to_string())?;
    let result = postcard::from_bytes(bytes)
        .map_err(|error| format!("the result of the pilot is not one ({error})"))?;
    Ok(PilotState { identity, stage, rays, result })
}

const RESULT: &str = "result";

/// A part of a run.
pub fn of_part(Part { scene, part }: &Part) -> Draft<'_> {
    let segment = |of: &Segment| OfSegment { first: of.first, count: of.count, rays: of.rays };
    let mut draft = with_header(&OfPart {
        kind: Kind::Part,
        scene: scene.clone(),
        identity: part.identity.clone(),
        stage: part.stage,
        segments: part.segments.iter().map(segment).collect(),
    });
    for (k, segment) in part.segments.iter().enumerate() {
        let squares = Squares::of(segment.count);
        push_sums(&mut draft, &format!("receivers_{k}"), &segment.receivers, squares);
        push_sums(&mut draft, &format!("checks_{k}"), &segment.checks, squares);
        push_sums(&mut draft, &format!("given_up_{k}"), &segment.given_up, squares);
    }
    draft
}

/// A part of a run. The error says what is wrong.
pub fn part(checkpoint: &Checkpoint) -> Result<Part, String> {
    let OfPart { scene, identity, stage, segments, .. } = header(checkpoint, Kind::Part)?;
    let segment = |(k, of): (usize, OfSegment)| {
        let OfSegment { first, count, rays } = of;
        let sums = |name: &str| sums(checkpoint, &format!("{name}_{k}"), Squares::of(count));
        let (receivers, checks, given_up) =
            (sums("receivers")?, sums("checks")?, sums("given_up")?);
        Ok(Segment { first, count, rays, receivers, checks, given_up })
    };
    let segments = segments.into_iter().enumerate().map(segment).collect::<Result<_, String>>()?;
    let part = RunPart { identity, stage, segments };
    if part.is_sound() { Ok(Part { scene, part }) } else { Err(UNSOUND.into()) }
}

const UNSOUND: &str = "its increments overlap, or have sums of different lengths";

/// How squares of sums are stored.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Squares {
    Kept,
    /// Those of one increment follow from its sums.
    Implied,
}

impl Squares {
    const fn of(increments: u64) -> Self {
        if increments == 1 { Self::Implied } else { Self::Kept }
    }
}

fn with_header<'a>(header: &impl Serialize) -> Draft<'a> {
    Draft::new(serde_json::to_value(header).expect("plain values always have a JSON value"))
}

fn kind(checkpoint: &Checkpoint) -> Result<Kind, String> {
    let read = AnyKind::deserialize(&checkpoint.header);
    read.map(|of| of.kind).map_err(|error| format!("its header is not that of a run ({error})"))
}

fn header<T: DeserializeOwned>(checkpoint: &Checkpoint, wanted: Kind) -> Result<T, String> {
    let kind = kind(checkpoint)?;
    if kind != wanted {
        return Err(format!("it is {}, not {}", kind.name(), wanted.name()));
    }
    T::deserialize(&checkpoint.header)
        .map_err(|error| format!("its header is not that of {} ({error})", wanted.name()))
}

fn push_sums<'a>(draft: &mut Draft<'a>, name: &str, sums: &'a [Sums], squares: Squares) {
    draft.push(format!("{name}_values"), sums.iter().map(|of| of.values));
    draft.push(format!("{name}_totals"), sums.iter().map(|of| of.totals));
    if squares == Squares::Kept {
        draft.push(format!("{name}_squares"), sums.iter().map(|of| of.squares));
    }
}

fn sums(checkpoint: &Checkpoint, name: &str, kept: Squares) -> Result<Vec<Sums>, String> {
    let part = |part: &str| format!("{name}_{part}");
    let told = |error: ArrayError| error.to_string();
    let values = checkpoint.rows(&part("values")).map_err(told)?;
    let totals = checkpoint.rows(&part("totals")).map_err(told)?;
    let of = values.zip(totals);
    Ok(match kept {
        Squares::Kept => {
            let squares = checkpoint.rows(&part("squares")).map_err(told)?;
            of.zip(squares)
                .map(|((values, totals), squares)| Sums { values, totals, squares })
                .collect()
        }
        Squares::Implied => {
            let squares = |totals: [i64; 3]| totals.map(|of| i128::from(of) * i128::from(of));
            of.map(|(values, totals)| Sums { values, totals, squares: squares(totals) }).collect()
        }
    })
}
