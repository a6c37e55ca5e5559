//! Layout: drawing units, text widths, label placement.

/// Drawing units per CSS pixel; the backend uses integer units.
pub(super) const UNIT: f64 = 10.0;

/// Height of the letters in CSS pixels.
pub(super) const LETTERS: f64 = 13.0;

/// Converts CSS pixels to drawing units.
pub(super) fn units(pixels: f64) -> u32 {
    (pixels * UNIT).round().max(0.0) as u32
}

/// Estimates the width of a text in CSS pixels, because the page's font is unknown here.
pub(super) fn width_of(text: &str) -> f64 {
    let letters = text.chars().filter(|c| !('\u{300}'..='\u{36f}').contains(c)).count();
    0.56 * LETTERS * letters as f64
}

/// Moves heights at least `gap` apart with minimal displacement: groups that touch merge and keep
/// their mean.
pub(super) fn spread(heights: &[f64], gap: f64) -> Vec<f64> {
    let mut order: Vec<usize> = (0..heights.len()).collect();
    order.sort_by(|&a, &b| heights[a].total_cmp(&heights[b]));
    let mut groups: Vec<(f64, Vec<usize>)> = Vec::new();
    for index in order {
        groups.push((heights[index], vec![index]));
        while let [.., (a, left), (b, right)] = &groups[..] {
            let reach = gap * (left.len() + right.len()) as f64 / 2.0;
            if b - a >= reach {
                break;
            }
            let all: Vec<usize> = left.iter().chain(right).copied().collect();
            let mean = all.iter().map(|&i| heights[i]).sum::<f64>() / all.len() as f64;
            groups.truncate(groups.len() - 2);
            groups.push((mean, all));
        }
    }
    let mut apart = heights.to_vec();
    for (mean, members) in groups {
        for (k, &index) in members.iter().enumerate() {
            apart[index] = mean + gap * (k as f64 - (members.len() as f64 - 1.0) / 2.0);
        }
    }
    apart
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_move_apart_minimally() {
        assert_eq!(spread(&[0.0, 20.0], 10.0), [0.0, 20.0]);
        assert_eq!(spread(&[4.0, 0.0], 10.0), [7.0, -3.0]);
        // The pair pushes into the third, so all three share one mean.
        assert_eq!(spread(&[0.0, 4.0, 11.0], 10.0), [-5.0, 5.0, 15.0]);
        assert_eq!(spread(&[], 10.0), [0.0; 0]);
    }
}
