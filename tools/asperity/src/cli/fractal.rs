//! Options of `fractal`.

use std::path::PathBuf;

use clap::Args;

use crate::cli::value::whole;

/// Options of `fractal`.
#[derive(Debug, Args)]
pub struct Fractal {
    /// Points that the function interpolates, as `X,Y X,Y …` [default: `0,0 0.5,0.5 1,0`,
    /// Takagi's function].
    #[arg(long, value_name = "POINTS", allow_hyphen_values = true, value_parser = points)]
    pub knots: Option<Points>,
    /// Vertical scaling of each map, in (−1, 1), or one number for all maps [default: 0.5].
    #[arg(long, value_name = "A,…", allow_hyphen_values = true, value_parser = numbers)]
    pub scaling: Option<Numbers>,
    /// Function of a JSON file with `knots`, `alpha` and `q`, as in `tables`.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["knots", "scaling"])]
    pub system: Option<PathBuf>,
    /// Integrate the function this many times, from its left end.
    #[arg(long, value_name = "TIMES", default_value_t = 0, value_parser = whole(0, 2))]
    pub integral: u32,
    /// Interval of the reported integral and mean [default: the domain].
    #[arg(long, value_name = "L,R", allow_hyphen_values = true, value_parser = interval)]
    pub over: Option<[f64; 2]>,
    /// Number of samples, or along each axis of a surface [default: 2049; surfaces 257].
    #[arg(long, value_parser = whole(2, 1_000_000))]
    pub samples: Option<u32>,
    /// Output file: .svg (plot), .csv or .npy (x, f(x)), or .obj (the surface z = f(x) f(y)).
    #[arg(long, value_name = "FILE", default_value = "fractal.svg")]
    pub out: PathBuf,
}

/// Points of a plane. A name, since a list of an option is one of its occurrences.
pub type Points = std::sync::Arc<[[f64; 2]]>;

/// Numbers.
pub type Numbers = std::sync::Arc<[f64]>;

fn number(text: &str) -> Option<f64> {
    text.trim().parse().ok().filter(|x: &f64| x.is_finite())
}

fn pair(text: &str) -> Option<[f64; 2]> {
    let (x, y) = text.split_once(',')?;
    Some([number(x)?, number(y)?])
}

fn points(text: &str) -> Result<Points, &'static str> {
    let points: Option<Points> = text.split_whitespace().map(pair).collect();
    points.ok_or("must be points such as \"0,0 1,1 2,0\"")
}

fn numbers(text: &str) -> Result<Numbers, &'static str> {
    let numbers: Option<Numbers> = text.split(',').map(number).collect();
    numbers.ok_or("must be numbers such as 0.5,-0.3")
}

fn interval(text: &str) -> Result<[f64; 2], &'static str> {
    pair(text).filter(|[l, r]| l <= r).ok_or("must be two numbers in ascending order, such as 0,0.5")
}
