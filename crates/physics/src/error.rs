//! What physics refuses, and why.

use simbeeotic_kernel::SimTime;

/// A body or a command that makes no sense. Nothing has changed when it is returned.
///
/// The message says what was wrong with which value; whoever knows the body's name puts it in front.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BodyError {
    /// A value is NaN or infinite.
    #[error("{what} is not finite: {value:?}")]
    NotFinite {
        /// The quantity, with its unit.
        what: &'static str,
        /// The values given; unused places are 0.
        value: [f64; 3],
    },
    /// A value has to be above zero.
    #[error("{what} has to be positive, not {value}")]
    NotPositive {
        /// The quantity, with its unit.
        what: &'static str,
        /// The value given.
        value: f64,
    },
    /// A value is outside of its range.
    #[error("{what} has to lie between {min} and {max}, not at {value}")]
    OutOfRange {
        /// The quantity, with its unit.
        what: &'static str,
        /// The value given, or the length of the vector given.
        value: f64,
        /// The least value that is accepted.
        min: f64,
        /// The greatest value that is accepted.
        max: f64,
    },
    /// Three moments of inertia that no body can have: each is at most the sum of the other two.
    #[error(
        "no body has the moments of inertia {moments:?} kg m^2: each is at most the sum of the other two"
    )]
    Inertia {
        /// The moments about the body's axes.
        moments: [f64; 3],
    },
    /// A shape that may not move (yet).
    #[error("a {shape} can only be fixed in the world, not move")]
    ShapeMoves {
        /// The name of the shape.
        shape: &'static str,
    },
    /// Points that all lie in one plane, where a solid is needed.
    #[error("the points of the {shape} lie in one plane: there is no volume between them")]
    Flat {
        /// The name of the shape.
        shape: &'static str,
    },
    /// Too few or too many of something.
    #[error("there have to be {min} to {max} {what}, not {count}")]
    Count {
        /// What is counted.
        what: &'static str,
        /// How many there are.
        count: usize,
        /// The least number that is accepted.
        min: usize,
        /// The greatest number that is accepted.
        max: usize,
    },
    /// A triangle with a corner that is no point of the mesh.
    #[error("a triangle has point {corner} for a corner; the mesh has {points}, counted from 0")]
    Corner {
        /// The index given.
        corner: u32,
        /// The number of points.
        points: usize,
    },
    /// Heights that do not fill whole rows.
    #[error("{heights} heights do not make whole rows of {columns}")]
    Rows {
        /// The number of heights.
        heights: usize,
        /// The number of heights in a row.
        columns: usize,
    },
    /// A compound that cannot be.
    #[error("a compound cannot consist of {part}")]
    Part {
        /// What it consists of.
        part: &'static str,
    },
    /// A part that a body which moves freely cannot have.
    #[error("a compound with a {part} in it can only be fixed or driven, not move freely")]
    PartMoves {
        /// The name of the part's shape.
        part: &'static str,
    },
    /// A shape whose centre of mass is not at its origin, or whose principal axes are not x, y and z,
    /// for a body that moves freely.
    #[error(
        "the centre of mass of the {shape} lies at {centre:?} m, and a free body's at the origin with x, y and z as principal axes: Shape::centred moves it there"
    )]
    OffCentre {
        /// The name of the shape.
        shape: &'static str,
        /// Its centre of mass.
        centre: [f64; 3],
    },
    /// A force or an impulse on a body that is fixed or driven from outside.
    #[error("{command} has no effect on a body that is {mobility}")]
    Immovable {
        /// What was asked for.
        command: &'static str,
        /// `fixed` or `driven`.
        mobility: &'static str,
    },
    /// A command for a time before the body's last change.
    #[error("a command for {asked} comes after one for {last}")]
    Backwards {
        /// The time of the command.
        asked: SimTime,
        /// The time of the body's last change.
        last: SimTime,
    },
    /// More than 2^32 - 2 bodies.
    #[error("there are too many bodies")]
    TooMany,
}

/// The threads that were asked for cannot be started.
#[derive(Debug, thiserror::Error)]
#[error("threads for physics cannot be started")]
pub struct ThreadsError(#[from] rayon::ThreadPoolBuildError);

/// Nothing if `value` is finite.
pub(crate) fn finite(what: &'static str, value: glam::DVec3) -> Result<(), BodyError> {
    if value.is_finite() {
        Ok(())
    } else {
        Err(BodyError::NotFinite {
            what,
            value: value.to_array(),
        })
    }
}

/// Nothing if `value` is finite and no longer than `max`.
#[inline]
pub(crate) fn bounded(what: &'static str, value: glam::DVec3, max: f64) -> Result<(), BodyError> {
    // False for NaN and infinity, too.
    if value.length_squared() <= max * max {
        return Ok(());
    }
    finite(what, value)?;
    Err(BodyError::OutOfRange {
        what,
        value: value.length(),
        min: 0.0,
        max,
    })
}

/// Nothing if `value` is a number from `min` to `max`.
pub(crate) fn ranged(what: &'static str, value: f64, min: f64, max: f64) -> Result<(), BodyError> {
    if !value.is_finite() {
        Err(BodyError::NotFinite {
            what,
            value: [value, 0.0, 0.0],
        })
    } else if (min..=max).contains(&value) {
        Ok(())
    } else {
        Err(BodyError::OutOfRange {
            what,
            value,
            min,
            max,
        })
    }
}

/// Nothing if `value` is a number above zero and at most `max`.
pub(crate) fn positive(what: &'static str, value: f64, max: f64) -> Result<(), BodyError> {
    if !value.is_finite() {
        Err(BodyError::NotFinite {
            what,
            value: [value, 0.0, 0.0],
        })
    } else if value <= 0.0 {
        Err(BodyError::NotPositive { what, value })
    } else {
        ranged(what, value, 0.0, max)
    }
}

/// Nothing if `attitude` is finite and of unit length, give or take 1e-6.
pub(crate) fn attitude(attitude: simbeeotic_units::Attitude) -> Result<(), BodyError> {
    let q = attitude.quat();
    if !q.is_finite() {
        return Err(BodyError::NotFinite {
            what: "attitude",
            value: [q.x, q.y, q.z],
        });
    }
    ranged(
        "length of the attitude's quaternion",
        q.length(),
        1.0 - 1e-6,
        1.0 + 1e-6,
    )
}
