//! Golden bits: pinned values of every public function. A change here is value-breaking and belongs in the CHANGELOG.

use asperity_noise::{
    Gaussian, GaussianOctaves, IntegerHash, Lattice, Noise, Normalisation, Octaves, Perlin1985, Perlin2002,
    PermutationTable, Point, Sample, Simplex, Spectrum, edge_direction_2, edge_direction_3,
    gaussian_variates_2, gaussian_variates_3,
    glam::{Vec2, Vec3},
    second_word, unit_direction_2, unit_direction_3,
};

const P2: Vec2 = Vec2::new(-3.7, 12.3);
const P3: Vec3 = Vec3::new(-3.7, 12.3, 0.45);
const WORD: u64 = 0xfedc_ba98_7654_3210;

fn bits(values: &[f32]) -> Vec<u32> {
    values.iter().map(|value| value.to_bits()).collect()
}

fn bits2(sample: Sample<Vec2>) -> Vec<u32> {
    bits(&[sample.value, sample.gradient.x, sample.gradient.y])
}

fn bits3(sample: Sample<Vec3>) -> Vec<u32> {
    bits(&[sample.value, sample.gradient.x, sample.gradient.y, sample.gradient.z])
}

fn gaussian_octaves<V: Point>() -> GaussianOctaves<V> {
    GaussianOctaves::new(Spectrum::default(), 17)
}

/// The statistics that these sums are normalised by are measured ones: new tables give new bits.
fn octaves<V: Point>(normalisation: Normalisation) -> Octaves<Perlin2002, V>
where
    Perlin2002: Noise<V>,
{
    Octaves::new(Perlin2002::default(), Spectrum::default(), normalisation, 17)
}

fn spectrum(values: impl Fn(Spectrum) -> Vec<f32>) -> Vec<u32> {
    bits(&values(Spectrum::default()))
}

#[test]
fn words_are_pinned() {
    assert_eq!(
        vec![IntegerHash.hash2(-4, 12, 17), IntegerHash.hash3(-4, 12, 9, 17), second_word(WORD)],
        [0x0b0f_c8e3_fe4a_2f8c, 0xf936_0b6f_65ca_07c6, 0x5534_de8e_b0f3_05de]
    );
    assert_eq!(
        vec![PermutationTable::new(17).hash2(-4, 12, 17), PermutationTable::new(17).hash3(-4, 12, 9, 17)],
        [0xd38f_294f_19ed_b9ed, 0x3231_a3c9_54fe_2bcf]
    );
    assert_eq!(
        PermutationTable::new(17).entries()[..8].to_vec(),
        [0x31, 0xf1, 0xc6, 0x3e, 0x83, 0x35, 0x8b, 0x42]
    );
    assert_eq!(
        vec![PermutationTable::new(17).index(-4, 12, 9), PermutationTable::new(18).index(-4, 12, 9)],
        [0xd9, 0xed]
    );
}

#[test]
fn variates_are_pinned() {
    assert_eq!(bits(&gaussian_variates_2(WORD)), [0xbf4b_10f7, 0x3e77_b90e, 0x3f53_639e]);
    assert_eq!(bits(&gaussian_variates_3(WORD)), [0xbf4b_10f7, 0x3e77_b90e, 0x3f53_639e, 0x4027_15bd]);
    assert_eq!(bits(&unit_direction_2(WORD).to_array()), [0x3e8f_f33f, 0x3f75_ac7b]);
    assert_eq!(bits(&unit_direction_3(WORD).to_array()), [0x3db4_3ced, 0x3e99_cd65, 0x3f73_228f]);
    assert_eq!(bits(&edge_direction_2(WORD).to_array()), [0x3f80_0000, 0xbf80_0000]);
    assert_eq!(bits(&edge_direction_3(WORD).to_array()), [0x0000_0000, 0xbf80_0000, 0xbf80_0000]);
}

#[test]
fn planar_kinds_are_pinned() {
    assert_eq!(bits2(Perlin1985::default().sample(P2, 17)), [0x3ea8_7b18, 0x3dc6_7181, 0xbd7b_d86d]);
    assert_eq!(bits2(Perlin2002::default().sample(P2, 17)), [0x3ec4_453e, 0x3f0d_df70, 0xbe73_8d9e]);
    assert_eq!(
        bits2(Perlin2002(PermutationTable::new(17)).sample(P2, 17)),
        [0xbe41_7c32, 0x3e85_262b, 0x3f62_e6be]
    );
    assert_eq!(bits2(Simplex::CONTINUOUS.sample(P2, 17)), [0x3f34_fcaa, 0xbf00_09c7, 0x3f04_503b]);
    assert_eq!(bits2(Simplex::WIDE.sample(P2, 17)), [0x3f31_f877, 0xbd84_cf96, 0x3f18_2f4a]);
    assert_eq!(
        bits2(Simplex::WIDE.with_lattice(PermutationTable::new(17)).sample(P2, 17)),
        [0x3e17_119e, 0xc02c_563e, 0xc006_091d]
    );
    assert_eq!(bits2(Gaussian::default().sample(P2, 17)), [0x3fb1_f735, 0xbe1f_2400, 0x3e86_cc8a]);
    assert_eq!(bits2(Gaussian::default().pair(P2, 17)[1]), [0xbfe5_982e, 0x4064_bcb7, 0x3e9b_d0de]);
    assert_eq!(bits2(Gaussian::default().with_variance(P2, 17).0), [0x3faf_5e2c, 0xbf23_c0ae, 0xbe68_87b4]);
    assert_eq!(bits2(Gaussian::default().with_variance(P2, 17).1), [0x3f78_94ac, 0xbf30_8b7f, 0xbf30_8b78]);
}

#[test]
fn spatial_kinds_are_pinned() {
    assert_eq!(
        bits3(Perlin1985::default().sample(P3, 17)),
        [0x3e50_70ff, 0x3d83_e6bf, 0x3e02_ea0b, 0x3de5_aaa5]
    );
    assert_eq!(
        bits3(Perlin2002::default().sample(P3, 17)),
        [0x3dec_88f3, 0x3e3f_3b92, 0xbf76_4581, 0xbfa3_985e]
    );
    assert_eq!(
        bits3(Perlin2002(PermutationTable::new(17)).sample(P3, 17)),
        [0xbdda_2a26, 0x3f0a_cb86, 0xbf14_6024, 0xbf74_cfaf]
    );
    assert_eq!(
        bits3(Simplex::CONTINUOUS.sample(P3, 17)),
        [0x3684_79c2, 0x3fca_f21a, 0xbfcb_186c, 0x3a8e_e866]
    );
    assert_eq!(bits3(Simplex::WIDE.sample(P3, 17)), [0x3b75_0949, 0x3fc1_b536, 0xbfd3_aa2f, 0x3e0f_63a5]);
    assert_eq!(
        bits3(Simplex::WIDE.with_lattice(PermutationTable::new(17)).sample(P3, 17)),
        [0xbf03_3d51, 0xbf85_0c3d, 0xbf51_ebaf, 0x3fe4_2db7]
    );
    assert_eq!(
        bits3(Gaussian::default().sample(P3, 17)),
        [0x3f93_6294, 0xbf7f_0256, 0x3fed_6d54, 0x3fdf_657a]
    );
    assert_eq!(
        bits3(Gaussian::default().pair(P3, 17)[1]),
        [0xbfb0_df21, 0x3fb5_823b, 0x3e12_a860, 0x40b5_a8e2]
    );
    assert_eq!(
        bits3(Gaussian::default().with_variance(P3, 17).0),
        [0x3f80_63e3, 0xbfc2_77a2, 0x3f76_dd44, 0x3fa4_62fc]
    );
    assert_eq!(
        bits3(Gaussian::default().with_variance(P3, 17).1),
        [0x3f42_4412, 0xbf7c_5ea5, 0xbf7c_5ea5, 0xbeb6_e4c2]
    );
}

#[test]
fn sums_are_pinned() {
    assert_eq!(bits2(gaussian_octaves().sample(P2, 6.5)), [0xbf01_08fe, 0xc024_a2eb, 0x4138_1c1d]);
    assert_eq!(bits2(gaussian_octaves().pair(P2, 6.5)[1]), [0xbeba_7dd9, 0xc097_60fe, 0x400d_1a69]);
    assert_eq!(
        bits3(gaussian_octaves().sample(P3, 6.5)),
        [0x3e05_f1e9, 0x4116_41cd, 0x4098_5068, 0xc0c1_3cfc]
    );
    assert_eq!(
        bits3(gaussian_octaves().pair(P3, 6.5)[1]),
        [0xbfc4_5f88, 0x400d_6252, 0xbe2c_115e, 0x40eb_de05]
    );
    assert_eq!(bits2(octaves(Normalisation::Range).sample(P2, 6.5)), [0x3ba9_9888, 0x3f86_cf77, 0x3e22_d7a5]);
    assert_eq!(
        bits2(octaves(Normalisation::Variance).sample(P2, 6.5)),
        [0x3ced_e6aa, 0x40bd_1b0e, 0x3f64_6d77]
    );
    assert_eq!(
        bits3(octaves(Normalisation::Range).sample(P3, 6.5)),
        [0x3cf1_9242, 0xbfa0_a3c8, 0x4004_611c, 0xbec1_bfd0]
    );
    assert_eq!(
        bits3(octaves(Normalisation::Variance).sample(P3, 6.5)),
        [0x3e46_61f9, 0xc103_eb96, 0x4159_6cb0, 0xc01f_1c42]
    );
}

#[test]
fn spectra_are_pinned() {
    assert_eq!(
        spectrum(|s| vec![s.frequency(9), s.amplitude(9), s.weight(6.25, 6)]),
        [0x4485_5de7, 0x3b00_0000, 0x3e80_0000]
    );
    assert_eq!(
        spectrum(|s| vec![
            s.sum_of_amplitudes(6.25),
            s.root_sum_of_squares(6.25),
            s.share(6.25),
            s.kurtosis_ratio(6.25)
        ]),
        [0x3ffc_8000, 0x3f93_c8d3, 0x3f7f_f0c0, 0x3f19_abe8]
    );
    assert_eq!(
        bits(&[
            gaussian_octaves::<Vec3>().share(3.3),
            octaves::<Vec3>(Normalisation::Range).standard_deviation(3.3)
        ]),
        [0x3f7c_451e, 0x3e2b_1bcf]
    );
    assert_eq!(bits(&[octaves::<Vec2>(Normalisation::Range).excess_kurtosis(3.3)]), [0xbe95_107d]);
}
