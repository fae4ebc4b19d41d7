//! Values in, pixels out: exposure, tone mapping, false colour.
