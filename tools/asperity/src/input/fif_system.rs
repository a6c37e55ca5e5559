//! Fractal interpolation functions from JSON files with `knots`, `alpha` and `q`.

use std::path::Path;

use asperity_fif::{Fif, Map, system::Piece};
use asperity_render::input_file;
use serde::Deserialize;

use crate::failure::Failure;

/// Maximum number of polynomial coefficients in a file: degree 7.
pub const COEFFICIENTS: usize = 8;

/// Large enough for a system of a million maps with full-precision numbers.
const MOST_BYTES: u64 = 1 << 28;

/// A validated system with its name.
pub struct System {
    name: String,
    /// The function.
    pub fif: Fif<COEFFICIENTS>,
}

/// The contents of the file: numbers, or fractions in quotes such as `"17/20"`.
#[derive(Deserialize)]
struct File {
    name: Option<String>,
    knots: Vec<Number>,
    alpha: Vec<Number>,
    /// Coefficients of q_j in ascending powers of x.
    q: Vec<Vec<Number>>,
    /// Ordinates, which are redundant. If present, they are compared with the computed values.
    y: Option<Vec<Number>>,
}

#[derive(Deserialize)]
#[serde(untagged)]
enum Number {
    Real(f64),
    Fraction(String),
}

impl Number {
    fn value(&self) -> Result<f64, String> {
        let number = |text: &str| text.trim().parse::<f64>().ok();
        match self {
            Self::Real(value) => Ok(*value),
            Self::Fraction(text) => match text.split_once('/') {
                Some((p, q)) => number(p).zip(number(q)).map(|(p, q)| p / q),
                None => number(text),
            }
            .ok_or_else(|| format!("`{text}` is not a number")),
        }
    }
}

fn values(numbers: &[Number]) -> Result<Vec<f64>, String> {
    numbers.iter().map(Number::value).collect()
}

impl System {
    /// Reads a system from a file. Every error contains the file name.
    pub fn read(path: &Path) -> Result<Self, Failure> {
        let name = path.file_stem().map_or_else(|| "system".into(), |stem| stem.to_string_lossy());
        let read = || -> Result<Self, Failure> {
            let bytes = input_file::read(path, MOST_BYTES)
                .map_err(|error| format!("cannot read the file: {error}"))?;
            Self::parse(std::str::from_utf8(&input_file::utf8(&bytes))?, &name)
        };
        read().map_err(|error| format!("system `{}`: {error}", path.display()).into())
    }

    /// Parses the text of a file. `name` is used if the text contains none.
    pub fn parse(text: &str, name: &str) -> Result<Self, Failure> {
        let file: File = serde_json::from_str(text)?;
        let mut q = Vec::new();
        for (j, polynomial) in file.q.iter().enumerate() {
            let given = values(polynomial)?;
            let degree = given.len().saturating_sub(1);
            let most = COEFFICIENTS - 1;
            if degree > most {
                return Err(format!("map {}: the degree must be at most {most}, got {degree}", j + 1).into());
            }
            let mut padded = [0.0; COEFFICIENTS];
            padded[..given.len()].copy_from_slice(&given);
            q.push(padded);
        }
        let (knots, alpha) = (values(&file.knots)?, values(&file.alpha)?);
        let fif = match &file.y {
            Some(y) => Fif::with_ordinates(&knots, &values(y)?, &alpha, &q)?,
            None => Fif::new(&knots, &alpha, &q)?,
        };
        Ok(Self { name: file.name.unwrap_or_else(|| name.into()), fif })
    }

    /// The functions f and g shown in the gallery.
    pub fn of_the_gallery() -> Result<Vec<Self>, Failure> {
        // Cochran, Lewis, Hart 2000, eq. 18 to 23.
        let read = |(name, alpha)| {
            let maps = r#""knots": [0, 1, 2], "q": [[0, 0.5], [1, -0.5]]"#;
            Self::parse(&format!(r#"{{ {maps}, "alpha": [{alpha}] }}"#), name)
        };
        [("f", "0.5, 0.5"), ("g", "0.85, -0.85")].into_iter().map(read).collect()
    }

    /// Returns a system of a function.
    pub fn of(name: &str, fif: Fif<COEFFICIENTS>) -> Self {
        Self { name: name.into(), fif }
    }

    /// Returns the display name.
    pub fn name(&self) -> String {
        format!("Fractal interpolation function {}", self.name)
    }

    /// Returns the folder name.
    pub fn slug(&self) -> String {
        self.name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '-' }).collect()
    }

    /// Returns knots, ordinates, factors and polynomials as JSON.
    pub fn parameters<const C: usize>(pieces: &[Piece<C>]) -> serde_json::Value {
        let maps: Vec<&Map<C>> = pieces.iter().map(Piece::map).collect();
        let ends = |end: fn(&Piece<C>) -> [f64; 2]| -> Vec<f64> {
            pieces.iter().take(1).map(|p| end(p)[0]).chain(pieces.iter().map(|p| end(p)[1])).collect()
        };
        serde_json::json!({
            "knots": ends(Piece::x),
            "y": ends(Piece::y),
            "alpha": maps.iter().map(|m| m.alpha).collect::<Vec<_>>(),
            "a": maps.iter().map(|m| m.a).collect::<Vec<_>>(),
            "b": maps.iter().map(|m| m.b).collect::<Vec<_>>(),
            "q": maps.iter().map(|m| m.q.to_vec()).collect::<Vec<_>>(),
        })
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_abs_diff_eq;

    use super::*;

    fn refused(text: &str) -> String {
        let error = System::parse(text, "test").err().expect("must be refused").to_string();
        assert!(!error.contains('\n'), "{error}");
        error
    }

    #[test]
    fn parse_fractions() {
        let text = r#"{"knots": ["0", 1, 2], "alpha": ["17/20", "-17/20"], "q": [["0", "1/2"], [1, -0.5]]}"#;
        let system = System::parse(text, "g").unwrap();
        assert_abs_diff_eq!(system.fif.evaluate(1.0, 1e-12).value, 1.0, epsilon = 1e-12);
        assert_eq!(system.fif.pieces()[0].map().alpha, 0.85);
    }

    #[test]
    fn read_accepts_a_byte_order_mark() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("line.json");
        let text = r#"{"knots": [0, 1, 2], "alpha": [0.5, 0.5], "q": [[0, 0.5], [1, -0.5]]}"#;
        std::fs::write(&file, format!("\u{feff}{text}")).unwrap();
        assert_eq!(System::read(&file).unwrap().name, "line");
    }

    #[test]
    fn parse_errors_are_distinct() {
        let lines = "[[0, 0.5], [1, -0.5]]";
        let file = |knots: &str, alpha: &str, q: &str| {
            format!(r#"{{"knots": {knots}, "alpha": {alpha}, "q": {q}}}"#)
        };
        let said = [
            refused(&file("[0, 2, 1]", "[0.5, 0.5]", lines)),
            refused(&file("[0, 1, 2]", "[0.5, 1]", lines)),
            refused(&file("[0, 1]", "[0.5]", "[[0, 0.5]]")),
            refused(&file("[0, 1, 2]", "[0.5, 0.5]", "[[0, 0.6], [1, -0.5]]")),
            refused(&file("[0, 1, 2]", "[0.5]", lines)),
            refused(&file("[0, 1, 2]", "[0.5, 0.5]", "[[0, 0.5], [\"x\"]]")),
            refused(&file("[0, 1, 2]", "[0.5, 0.5]", "[[0, 0.5], [0, 0, 0, 0, 0, 0, 0, 0, 1]]")),
            refused("{"),
        ];
        for (i, one) in said.iter().enumerate() {
            assert!(said.iter().skip(i + 1).all(|other| other != one), "{one}");
        }
    }
}
