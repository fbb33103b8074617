//! What a scenario file may say and what it hears if it says something else.

use proptest::prelude::*;
use serde::{Deserialize, Serialize, de::DeserializeOwned};
use simbeeotic_units::*;
use std::fmt::Debug;

fn read<T: DeserializeOwned>(json: &str) -> T {
    serde_json::from_str(json).unwrap_or_else(|error| panic!("{json}: {error}"))
}

/// The message alone, without the place that the format adds.
fn fault<T: DeserializeOwned + Debug>(json: &str) -> String {
    let error = serde_json::from_str::<T>(json).unwrap_err().to_string();
    error
        .split(" at line")
        .next()
        .unwrap_or_default()
        .to_owned()
}

#[test]
fn a_quantity_is_a_string_in_both_directions() {
    assert_eq!(read::<Speed>(r#""0.2 m/s""#), Speed::si(0.2));
    assert_eq!(
        serde_json::to_string(&Speed::si(0.2)).unwrap(),
        r#""0.2 m/s""#
    );
}

#[test]
fn a_bare_number_is_told_what_it_lacks() {
    assert_eq!(
        fault::<Angle>("12"),
        r#"12 is a bare number; give a unit, for example "12 rad""#
    );
    assert_eq!(
        fault::<Speed>("-3"),
        r#"-3 is a bare number; give a unit, for example "-3 m/s""#
    );
    assert_eq!(
        fault::<Speed>("0.2"),
        r#"0.2 is a bare number; give a unit, for example "0.2 m/s""#
    );
}

#[test]
fn other_types_are_told_what_belongs_there() {
    assert_eq!(
        fault::<Angle>("true"),
        r#"invalid type: boolean `true`, expected an angle with a unit, for example "1.5 rad""#
    );
    assert_eq!(
        fault::<Angle>(r#""12 m""#),
        r#"unknown unit "m" for an angle; use one of rad, deg, turn"#
    );
}

#[test]
fn what_could_not_be_read_back_is_not_written() {
    assert!(serde_json::to_string(&Speed::si(f64::NAN)).is_err());
    assert!(serde_json::to_string(&Position::from_xyz(0.0, f64::INFINITY, 0.0)).is_err());
}

#[test]
fn a_vector_is_three_quantities() {
    let p = Position::from_xyz(1.0, -2.0, 0.3);
    assert_eq!(read::<Position>(r#"["1 m", "-200 cm", "0.3 m"]"#), p);
    assert_eq!(
        serde_json::to_string(&p).unwrap(),
        r#"["1 m","-2 m","0.3 m"]"#
    );

    let expected =
        r#"expected three quantities [east, north, up], for example ["1 m", "0 m", "0.5 m"]"#;
    assert_eq!(
        fault::<Position>(r#"["1 m", "2 m"]"#),
        format!("invalid length 2, {expected}")
    );
    assert_eq!(
        fault::<Position>(r#"["1 m", "2 m", "3 m", "4 m"]"#),
        format!("invalid length 4, {expected}")
    );
    assert_eq!(
        fault::<Position>(r#""1 m""#),
        format!("invalid type: string \"1 m\", {expected}")
    );
    assert_eq!(
        fault::<Position>(r#"[1, 2, 3]"#),
        r#"1 is a bare number; give a unit, for example "1 m""#
    );
}

#[test]
fn an_attitude_is_a_heading_or_angles_or_a_quaternion() {
    let north: Attitude = read(r#"{ "heading": "0 deg" }"#);
    assert_eq!(north, Attitude::from_heading(Heading::NORTH));
    assert_eq!(
        read::<Attitude>(r#"{ "yaw": "90 deg" }"#),
        Attitude::from_yaw(Yaw::NORTH)
    );
    let tilted: Attitude = read(r#"{ "roll": "0.1 rad", "pitch": "0.2 rad" }"#);
    assert_eq!(
        tilted,
        Attitude::from_rpy(Angle::si(0.1), Angle::si(0.2), Yaw::EAST)
    );
    assert_eq!(read::<Attitude>("{}"), Attitude::IDENTITY);
    let unit: Attitude = read(r#"{ "w": 0.70710678, "x": 0, "y": 0, "z": 0.70710678 }"#);
    assert!(unit.angle_to(Attitude::from_yaw(Yaw::NORTH)) < Angle::si(1e-7));
    assert!((unit.quat().length() - 1.0).abs() < 1e-15);
}

#[test]
fn a_mixed_or_impossible_attitude_is_refused() {
    assert_eq!(
        fault::<Attitude>(r#"{ "heading": "0 deg", "yaw": "0 deg" }"#),
        "give an attitude in one form: heading, or yaw, pitch and roll, or w, x, y and z"
    );
    assert_eq!(
        fault::<Attitude>(r#"{ "w": 1, "x": 0 }"#),
        "a quaternion needs all of w, x, y and z"
    );
    assert_eq!(
        fault::<Attitude>(r#"{ "w": 2, "x": 0, "y": 0, "z": 0 }"#),
        "the length of the quaternion is 2; it must be 1"
    );
    assert!(fault::<Attitude>(r#"{ "yow": "1 rad" }"#).starts_with("unknown field `yow`"));
    assert!(fault::<Attitude>("3").contains("expected a table with heading, or with yaw"));
}

#[test]
fn what_is_left_out_of_a_pose_is_zero() {
    let pose: Pose = read(r#"{ "position": ["0 m", "0 m", "3 m"] }"#);
    assert_eq!(
        pose,
        Pose::new(Position::from_xyz(0.0, 0.0, 3.0), Attitude::IDENTITY)
    );
    assert_eq!(read::<Mount>("{}"), Mount::IDENTITY);
    assert!(fault::<Pose>(r#"{ "place": [] }"#).starts_with("unknown field `place`"));
}

/// Written and read again, it is the same. Through a tree of values, since the reader of JSON text
/// may be wrong in the last bit of a number.
fn survives<T: Serialize + DeserializeOwned + PartialEq + Debug>(value: T) {
    let json = serde_json::to_value(&value).unwrap();
    assert_eq!(
        serde_json::from_value::<T>(json.clone()).unwrap(),
        value,
        "{json}"
    );
}

proptest! {
    #[test]
    fn serde_there_and_back_is_the_identity(n in [-1e6..1e6_f64, -1e6..1e6, -1e6..1e6, -3.0..3.0]) {
        let [x, y, z, turn] = n;
        let attitude = Attitude::exp(V3::from_xyz(turn, -turn, 0.5 * turn));
        survives(Speed::si(x));
        survives(Heading::si(turn));
        survives(Yaw::si(turn));
        survives(attitude);
        survives(Pose::new(Position::from_xyz(x, y, z), attitude));
        survives(Mount::new(Offset::from_xyz(x, y, z), attitude));
        survives(Twist::new(Velocity::from_xyz(x, y, z), Rate::from_xyz(z, x, y)));
        survives(Wrench::new(ForceVec::from_xyz(x, y, z), TorqueVec::from_xyz(z, x, y)));
    }
}

#[test]
fn parameters_read_as_researchers_write_them() {
    #[derive(Debug, PartialEq, Deserialize)]
    struct Params {
        heading_sigma: Angle,
        control_period: Time,
        noise_floor: PowerLevel,
        ceiling: Option<Length>,
    }
    let params: Params = read(
        r#"{ "heading_sigma": "0.2 rad", "control_period": "100 ms", "noise_floor": "-100 dBm" }"#,
    );
    let expected = Params {
        heading_sigma: Angle::si(0.2),
        control_period: Time::from_millis(100.0),
        noise_floor: PowerLevel::from_dbm(-100.0),
        ceiling: None,
    };
    assert_eq!(params, expected);
}
