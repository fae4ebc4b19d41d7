//! Which calculation grids.

use crate::quantity;
use clap::Args;

/// Which points.
#[derive(Debug, Args)]
pub(crate) struct GridChoice {
    /// One grid of the scene only
    #[arg(long, value_name = "NAME", conflicts_with_all = ["height", "corner"])]
    pub name: Option<String>,
    /// A working plane at this height, m, over all of the floor plan
    #[arg(long, value_name = "M", value_parser = quantity::metres, allow_hyphen_values = true, conflicts_with = "corner")]
    pub height: Option<f64>,
    /// A corner of a grid, x,y,z, in metres and in the axes of the scene as written
    #[arg(long, value_name = "X,Y,Z", value_parser = quantity::triple, allow_hyphen_values = true, requires = "u", requires = "v")]
    pub corner: Option<[f64; 3]>,
    /// One side of it
    #[arg(long, value_name = "X,Y,Z", value_parser = quantity::side_m, allow_hyphen_values = true, requires = "corner")]
    pub u: Option<[f64; 3]>,
    /// The other side, at right angles
    #[arg(long, value_name = "X,Y,Z", value_parser = quantity::side_m, allow_hyphen_values = true, requires = "corner")]
    pub v: Option<[f64; 3]>,
    /// Distance of points, m [default: that of EN 12464-1]
    #[arg(long, value_name = "M", value_parser = quantity::spacing_m, allow_hyphen_values = true)]
    pub spacing: Option<f64>,
    /// Width of the band along the sides that is left out, m [default: with --height half a metre or 15 % of the
    /// shorter side, whichever is less; else none]
    #[arg(long, value_name = "M", value_parser = quantity::border_m, allow_hyphen_values = true)]
    pub border: Option<f64>,
}

impl GridChoice {
    /// Whether nothing is asked for.
    pub(crate) const fn is_empty(&self) -> bool {
        self.name.is_none() && self.height.is_none() && self.corner.is_none()
    }
}
