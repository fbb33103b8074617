//! Quantities with units as text, vectors that know their frame, and mathematics whose bits agree
//! on every machine.
//!
//! ```
//! use simbeeotic_units::{Angle, Attitude, Flu, Heading, Position, Speed, Time, Velocity};
//!
//! let cruise: Speed = "7.2 km/h".parse()?;
//! let forward = Velocity::<Flu>::new(cruise, Speed::ZERO, Speed::ZERO);
//!
//! // A bee whose nose points north flies for 2.5 s.
//! let attitude = Attitude::from_heading(Heading::NORTH);
//! let position = Position::ZERO + attitude.rotate(forward) * Time::from_secs(2.5);
//! assert!((position.north().metres() - 5.0).abs() < 1e-12);
//! assert!(position.east().metres().abs() < 1e-12);
//!
//! // A unit is part of the text; without it nothing is guessed.
//! let error = "12".parse::<Angle>().unwrap_err();
//! assert_eq!(error.to_string(), r#"12 needs a unit, for example "12 rad""#);
//! # Ok::<(), simbeeotic_units::QuantityError>(())
//! ```
//!
//! # Three ideas
//!
//! **A quantity is an `f64` in SI with a type.** [`Speed`] plus [`Time`] does not compile; [`Speed`]
//! times [`Time`] is a [`Length`]. In text a quantity carries its unit, always: `"0.2 m/s"`,
//! `"-100 dBm"`. A bare number is an error, in scenario files too, and every error says what to
//! write instead. Inside hot loops the bare number comes out with [`Length::get`] and goes in again
//! with [`Length::si`]; both cost nothing.
//!
//! **A vector has a frame.** The world is [`Enu`] (east, north, up), the body is [`Flu`] (forward,
//! left, up); both are right-handed, as in ROS REP-103. Adding a vector of one to a vector of the
//! other does not compile; [`Attitude`] turns one into the other. [`Heading`] (clockwise from
//! north, what a compass says) and [`Yaw`] (counter-clockwise from east, what mathematics says) are
//! different types.
//!
//! **Bits agree.** Sine, exponential and power come from `libm` through [`math`], never from the
//! platform, so that a run on one machine is the run on another.
//!
//! # Reading order
//!
//! 1. [`quantity`]: what a quantity can do, its text form, the products between quantities;
//! 2. [`space`]: frames, vectors, attitude, heading and yaw, poses;
//! 3. [`math`]: deterministic functions, the normal distribution;
//! 4. [`constants`] and [`text`]: the speed of light, and "did you mean".

pub mod constants;
pub mod math;
pub mod quantity;
pub mod space;
pub mod text;

/// The linear algebra below the typed vectors, at the version this crate uses.
pub use glam;
pub use quantity::{
    Acceleration, Angle, AngularRate, Area, Charge, Circulation, Concentration, Conductivity,
    Current, DataRate, Decibels, Density, Energy, Force, Frequency, Illuminance, Impulse, Length,
    LuminousIntensity, MagneticField, Mass, MassRate, Power, PowerLevel, Pressure, Quantity,
    QuantityError, RainRate, Resistance, Scale, Speed, Temperature, Time, Torque, Unit,
    VectorQuantity, Voltage,
};
pub use space::{
    Accel, Attitude, Enu, Flu, ForceVec, Frame, Heading, ImpulseVec, Mount, Offset, Pose, Position,
    Rate, TorqueVec, Twist, V3, Velocity, Wrench, Yaw,
};
pub use text::did_you_mean;
