//! The channels of a recording.

use crate::schema::{self, Type};

/// One channel of our recordings.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Topic {
    Vehicles,
    Poses,
    Twists,
    Log,
    Events,
    Metrics,
}

impl Topic {
    pub(crate) const ALL: [Topic; 6] = [
        Topic::Vehicles,
        Topic::Poses,
        Topic::Twists,
        Topic::Log,
        Topic::Events,
        Topic::Metrics,
    ];

    pub(crate) fn name(self) -> &'static str {
        match self {
            Topic::Vehicles => "/vehicles",
            Topic::Poses => "/poses",
            Topic::Twists => "/twists",
            Topic::Log => "/log",
            Topic::Events => "/events",
            Topic::Metrics => "/metrics",
        }
    }

    pub(crate) fn named(name: &str) -> Option<Topic> {
        Topic::ALL.into_iter().find(|topic| topic.name() == name)
    }

    pub(crate) fn schema(self) -> &'static Type {
        match self {
            Topic::Vehicles => &schema::VEHICLES,
            Topic::Poses => &schema::POSES_IN_FRAME,
            Topic::Twists => &schema::TWISTS,
            Topic::Log => &schema::LOG,
            Topic::Events => &schema::EVENT,
            Topic::Metrics => &schema::METRICS,
        }
    }
}
