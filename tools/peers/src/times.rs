//! Times of all contenders, their medians and ratios.

/// Name of Asperity's contenders.
pub(crate) const OURS: &str = "asperity";

/// The SIMD levels of each processor family, in increasing order.
const LEVELS: [&str; 8] = ["scalar", "sse2", "sse4.1", "sse4.2", "avx2", "avx512", "neon", "wasm128"];

/// The whole measurement.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Times {
    /// Distance of grid points in lattice cells.
    pub(crate) step: f32,
    pub(crate) rounds: u32,
    pub(crate) rows: Vec<Row>,
}

/// A form, dimension and noise, with all measured contenders.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Row {
    pub(crate) name: String,
    pub(crate) contenders: Vec<Contender>,
}

/// A library at a SIMD level.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Contender {
    pub(crate) library: String,
    pub(crate) version: String,
    pub(crate) level: String,
    /// Per sample, by round.
    pub(crate) nanoseconds: Vec<f64>,
}

/// Asperity at a level compared with the fastest peer at that level or below.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Ratio<'a> {
    pub(crate) ours: &'a Contender,
    pub(crate) peer: &'a Contender,
}

impl Contender {
    /// Returns the median.
    pub(crate) fn median(&self) -> f64 {
        quantile(&self.nanoseconds, 0.5)
    }

    /// Returns half the interquartile range.
    pub(crate) fn spread(&self) -> f64 {
        (quantile(&self.nanoseconds, 0.75) - quantile(&self.nanoseconds, 0.25)) / 2.0
    }

    fn rank(&self) -> usize {
        LEVELS.iter().position(|level| *level == self.level).unwrap_or(LEVELS.len())
    }
}

impl Row {
    /// Returns the beginning of its name, up to the dimension.
    pub(crate) fn form(&self) -> &str {
        self.name.split('/').next().unwrap_or_default()
    }

    /// Returns one ratio per Asperity level, in the order of measurement.
    pub(crate) fn ratios(&self) -> Vec<Ratio<'_>> {
        let (ours, peers): (Vec<_>, Vec<_>) = self.contenders.iter().partition(|c| c.library == OURS);
        ours.into_iter()
            .filter_map(|ours| {
                let among = peers.iter().filter(|peer| peer.rank() <= ours.rank());
                let peer = among.min_by(|a, b| a.median().total_cmp(&b.median()))?;
                Some(Ratio { ours, peer })
            })
            .collect()
    }
}

impl Ratio<'_> {
    /// Returns the speed of Asperity relative to the peer.
    pub(crate) fn value(&self) -> f64 {
        self.peer.median() / self.ours.median()
    }
}

/// Returns the quantile of the values with linear interpolation, or NaN without values.
fn quantile(values: &[f64], share: f64) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let place = share * sorted.len().saturating_sub(1) as f64;
    let (low, high) = (place.floor() as usize, place.ceil() as usize);
    match (sorted.get(low), sorted.get(high)) {
        (Some(a), Some(b)) => a + (b - a) * (place - place.floor()),
        _ => f64::NAN,
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    pub(crate) fn contender(library: &str, level: &str, nanoseconds: &[f64]) -> Contender {
        let (library, version, level) = (library.to_owned(), "1.2.3".to_owned(), level.to_owned());
        Contender { library, version, level, nanoseconds: nanoseconds.to_vec() }
    }

    pub(crate) fn row() -> Row {
        Row {
            name: "fill_grid/2-d/perlin-2002".into(),
            contenders: vec![
                contender("asperity", "scalar", &[10.0, 8.0, 30.0]),
                contender("asperity", "avx2", &[2.0, 2.0, 2.0]),
                contender("fast", "sse4.1", &[5.0, 5.0, 5.0]),
                contender("fast", "avx512", &[1.0, 1.0, 1.0]),
                contender("plain", "scalar", &[20.0, 20.0, 20.0]),
            ],
        }
    }

    #[test]
    fn median_ignores_an_outlier() {
        assert_eq!(contender("", "", &[3.0, 900.0, 1.0]).median(), 3.0);
        assert_eq!(contender("", "", &[4.0, 1.0, 3.0, 2.0]).median(), 2.5);
        assert_eq!(contender("", "", &[1.0, 2.0, 3.0, 4.0, 5.0]).spread(), 1.0);
        assert!(contender("", "", &[]).median().is_nan());
    }

    #[test]
    fn peer_counts_at_its_level_and_above() {
        let row = row();
        let found: Vec<_> = row
            .ratios()
            .iter()
            .map(|r| (r.ours.level.clone(), r.peer.library.clone(), r.peer.level.clone(), r.value()))
            .collect();
        let line = |level: &str, peer: &str, at: &str, ratio| (level.into(), peer.into(), at.into(), ratio);
        assert_eq!(found, [line("scalar", "plain", "scalar", 2.0), line("avx2", "fast", "sse4.1", 2.5)]);
    }

    #[test]
    fn no_ratio_without_asperity_or_a_peer() {
        let mut row = row();
        row.contenders.retain(|c| c.library == OURS);
        assert_eq!(row.ratios(), []);
        row.contenders = vec![contender("plain", "scalar", &[1.0])];
        assert_eq!(row.ratios(), []);
    }
}
