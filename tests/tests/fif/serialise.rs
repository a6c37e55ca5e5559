//! Systems written to a file and read back.
#![expect(clippy::unwrap_used, reason = "a test that cannot read its own file has failed")]

use asperity_fif::{Fif, FixedFif, System, cochran_2000, system::Piece};
use asperity_tests::fif_systems::Reference;
use proptest::prelude::*;
use serde::de::value::{Error, MapDeserializer, SeqDeserializer};
use serde::de::{Deserializer, IntoDeserializer, Visitor};
use serde::{Deserialize, forward_to_deserialize_any};

use crate::properties::{affine, config, hermite};

const PAPER_F: &str = r#"{"x":[0.0,1.0,2.0],"y":[0.0,1.0,0.0],"alpha":[0.5,0.5],"q":[[0.0,0.5],[1.0,-0.5]]}"#;

fn read_back<S: AsRef<[Piece<C>]>, const C: usize>(system: &System<S, C>) -> Fif<C> {
    serde_json::from_str(&serde_json::to_string(system).unwrap()).unwrap()
}

#[test]
fn systems_round_trip_bit_exactly() {
    let system = Reference::<4>::load("cubic5").system;
    assert_eq!(read_back(&system).pieces(), system.pieces());
    assert_eq!(read_back(&cochran_2000::g_hat().unwrap()).pieces(), cochran_2000::g_hat().unwrap().pieces());
    assert_eq!(serde_json::to_string(&cochran_2000::f().unwrap()).unwrap(), PAPER_F);
    // Into an array, and with capacity for a higher degree.
    let fixed: FixedFif<2, 3> = serde_json::from_str(PAPER_F).unwrap();
    assert_eq!(fixed.pieces()[1].map().q, [1.0, -0.5, 0.0]);
}

proptest! {
    #![proptest_config(config(64))]

    #[test]
    fn any_system_is_read_back_with_the_same_bits(f in affine(0.999), smooth in hermite()) {
        let back = read_back(&f);
        prop_assert_eq!(back.pieces(), f.pieces());
        prop_assert_eq!((back.range(), back.evaluate(0.3, 0.0)), (f.range(), f.evaluate(0.3, 0.0)));
        let back = read_back(&smooth);
        prop_assert_eq!(back.pieces(), smooth.pieces());
    }
}

#[test]
fn deserialize_rejects_invalid_systems() {
    let refuse = |from: &str, to: &str, message: &str| {
        assert!(PAPER_F.contains(from));
        let error =
            serde_json::from_str::<FixedFif<2, 2>>(&PAPER_F.replace(from, to)).unwrap_err().to_string();
        assert!(error.starts_with(message), "{error}");
    };
    refuse(r#""alpha":[0.5,0.5]"#, r#""alpha":[0.5,1.5]"#, "`alpha` of map 2 must be in (-1, 1), got 1.5");
    refuse("[0.0,1.0,2.0]", "[0.0,2.0,2.0]", "knots must be strictly increasing: `x[2]` = 2 follows 2");
    refuse("[[0.0,0.5],", "[[0.0,0.5,0.0],", "`C` must be at least 3, got 2");
    refuse("[[0.0,0.5],", "[", "`q` must have 2 elements, got 1");
    refuse(r#""y":[0.0,1.0,0.0]"#, r#""y":[0.0,1.0]"#, "`y` must have 3 elements, got 2");
    refuse(
        r#""y":[0.0,1.0,0.0]"#,
        r#""y":[0.0,0.75,0.0]"#,
        "`q` of map 1 must send the right end to 0.75, got 1",
    );
    refuse(r#""x":[0.0,1.0,2.0],"#, "", "missing field `x`");
    refuse(r#"{"x""#, r#"{"z":0,"x""#, "unknown field `z`");
    refuse("[0.0,1.0,2.0]", "[0.0,null,2.0]", "invalid type: null, expected f64");
    for end in 0..PAPER_F.len() {
        assert!(serde_json::from_str::<FixedFif<2, 2>>(&PAPER_F[..end]).is_err(), "{end}");
    }
    // Three maps for an array of two.
    let three = Fif::affine(&[0.0, 1.0, 2.0, 3.0], &[0.0; 4], &[0.5; 3]).unwrap();
    let error = serde_json::from_str::<FixedFif<2, 2>>(&serde_json::to_string(&three).unwrap()).unwrap_err();
    assert!(error.to_string().starts_with("`storage` must have 3 elements, got 2"), "{error}");
}

/// Data in memory: a format that can represent NaN.
enum Memory {
    Number(f64),
    List(Vec<Self>),
}

impl<'de> Deserializer<'de> for Memory {
    type Error = Error;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        match self {
            Self::Number(x) => visitor.visit_f64(x),
            Self::List(list) => visitor.visit_seq(SeqDeserializer::new(list.into_iter())),
        }
    }

    forward_to_deserialize_any! {
        bool i8 i16 i32 i64 u8 u16 u32 u64 f32 f64 char str string bytes byte_buf option unit unit_struct
        newtype_struct seq tuple tuple_struct map struct enum identifier ignored_any
    }
}

impl IntoDeserializer<'_, Error> for Memory {
    type Deserializer = Self;

    fn into_deserializer(self) -> Self {
        self
    }
}

#[test]
fn deserialize_rejects_non_finite_numbers() {
    let read = |x: f64, y: f64, alpha: f64, c: f64| {
        let list = |numbers: &[f64]| Memory::List(numbers.iter().map(|&x| Memory::Number(x)).collect());
        let data = [
            ("x", list(&[0.0, x, 2.0])),
            ("y", list(&[0.0, y, 0.0])),
            ("alpha", list(&[0.5, alpha])),
            ("q", Memory::List(vec![list(&[0.0, 0.5]), list(&[1.0, c])])),
        ];
        Fif::<2>::deserialize(MapDeserializer::new(data.into_iter())).map_err(|error| error.to_string())
    };
    assert_eq!(read(1.0, 1.0, 0.5, -0.5).unwrap().pieces(), cochran_2000::f().unwrap().pieces());
    let refusals = [
        (read(f64::NAN, 1.0, 0.5, -0.5), "`x[1]` must be finite, got NaN"),
        (read(1.0, f64::INFINITY, 0.5, -0.5), "`y[1]` must be finite, got inf"),
        (read(1.0, 1.0, f64::NAN, -0.5), "`alpha` of map 2 must be in (-1, 1), got NaN"),
        (read(1.0, 1.0, 0.5, f64::NAN), "`q` of map 2 must have a finite coefficient of x^1, got NaN"),
    ];
    for (got, message) in refusals {
        assert_eq!(got.unwrap_err(), message);
    }
}
