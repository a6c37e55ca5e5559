//! Parsers of the values of options. An error names the expected value.

pub(super) fn assignment(text: &str) -> Result<(String, String), &'static str> {
    let parts = text.split_once('=').ok_or("must be NAME=VALUE, such as coat_roughness=0.1")?;
    Ok((parts.0.trim().into(), parts.1.trim().into()))
}

/// A parser of whole numbers of a range.
pub(super) fn whole(least: u32, most: u32) -> impl Fn(&str) -> Result<u32, String> + Clone + Send + Sync {
    move |text| {
        let number = text.parse().ok().filter(|n| (least..=most).contains(n));
        number.ok_or_else(|| format!("must be an integer from {least} to {most}"))
    }
}

pub(super) fn degrees(text: &str) -> Result<f32, &'static str> {
    let number = text.parse().ok().filter(|x: &f32| (0.0..=180.0).contains(x));
    number.ok_or("must be an angle from 0 to 180 degrees")
}

pub(super) fn field_of_view(text: &str) -> Result<f32, &'static str> {
    let number = text.parse().ok().filter(|x: &f32| (0.1..=170.0).contains(x));
    number.ok_or("must be an angle from 0.1 to 170 degrees")
}

pub(super) fn point(text: &str) -> Result<[f64; 3], &'static str> {
    let coordinate = |text: &str| text.trim().parse().ok().filter(|x: &f64| x.abs() <= 1e30);
    let all: Option<Vec<_>> = text.split(',').map(coordinate).collect();
    all.and_then(|all| all.try_into().ok()).ok_or("must be three numbers, such as 0,1.5,-4")
}

pub(super) fn turned(text: &str) -> Result<f32, &'static str> {
    let number = text.parse().ok().filter(|x: &f32| x.abs() <= 36_000.0);
    number.ok_or("must be an angle of at most 36000 degrees")
}

/// A number from 1, or a range of them, first and last.
pub(super) fn numbers(text: &str) -> Result<[u32; 2], &'static str> {
    let (first, last) = text.split_once('-').unwrap_or((text, text));
    match [first, last].map(str::parse) {
        [Ok(first), Ok(last)] if 1 <= first && first <= last => Ok([first, last]),
        _ => Err("must be a number from 1, or a range such as 13-24"),
    }
}

pub(super) fn positive(text: &str) -> Result<f32, &'static str> {
    let number = text.parse().ok().filter(|x: &f32| x.is_finite() && *x > 0.0);
    number.ok_or("must be a number above 0")
}

pub(super) fn fraction(text: &str) -> Result<f32, &'static str> {
    let number = text.parse().ok().filter(|x: &f32| (0.0..=1.0).contains(x));
    number.ok_or("must be a number from 0 to 1")
}

pub(super) fn share(text: &str) -> Result<f32, &'static str> {
    positive(text).ok().filter(|x| *x <= 1.0).ok_or("must be a number above 0 and at most 1")
}

pub(super) fn color(text: &str) -> Result<u32, &'static str> {
    let digits = text.trim_start_matches('#');
    match u32::from_str_radix(digits, 16) {
        Ok(rgb) if digits.len() == 6 => Ok(rgb),
        _ => Err("must be six hexadecimal digits, such as d9a066"),
    }
}

pub(super) fn finite(text: &str) -> Result<f32, &'static str> {
    let number = text.trim().parse().ok().filter(|x: &f32| x.is_finite());
    number.ok_or("must be a finite number")
}
