//! The channels of a recording.

use crate::schema::{self, Type};

/// One channel of our recordings.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Topic {
    Vehicles,
    /// What stands in the world.
    World,
    /// Points on it, for viewers that show no scenes.
    Points,
    /// The solids of it that a URDF can say, for Rerun.
    Solids,
    /// What models are made of.
    Models,
    Poses,
    /// Where all are, as points in their colours, for viewers that draw nothing at poses.
    Cloud,
    Twists,
    Log,
    Events,
    Metrics,
    Readings,
    Packets,
    Radio,
    Links,
    /// Made when there is wind.
    Wind,
    /// One channel for each sensor that takes pictures, made when it takes the first.
    Images,
}

impl Topic {
    pub(crate) const ALL: [Topic; 17] = [
        Topic::Vehicles,
        Topic::World,
        Topic::Points,
        Topic::Solids,
        Topic::Models,
        Topic::Poses,
        Topic::Cloud,
        Topic::Twists,
        Topic::Log,
        Topic::Events,
        Topic::Metrics,
        Topic::Readings,
        Topic::Packets,
        Topic::Radio,
        Topic::Links,
        Topic::Wind,
        Topic::Images,
    ];

    pub(crate) fn name(self) -> &'static str {
        match self {
            Topic::Vehicles => "/vehicles",
            Topic::World => "/world",
            Topic::Points => "/world/points",
            Topic::Solids => "/robot_description",
            Topic::Models => "/models",
            Topic::Poses => "/poses",
            Topic::Cloud => "/poses/points",
            Topic::Twists => "/twists",
            Topic::Log => "/log",
            Topic::Events => "/events",
            Topic::Metrics => "/metrics",
            Topic::Readings => "/readings",
            Topic::Packets => "/packets",
            Topic::Radio => "/radio",
            Topic::Links => "/links",
            Topic::Wind => "/wind",
            Topic::Images => "/images",
        }
    }

    pub(crate) fn named(name: &str) -> Option<Topic> {
        let is = |topic: &Topic| match topic {
            Topic::Images => name.starts_with("/images/"),
            _ => topic.name() == name,
        };
        Topic::ALL.into_iter().find(is)
    }

    /// What its messages are; of [`Topic::Solids`], which is no protobuf, nothing.
    pub(crate) fn schema(self) -> Option<&'static Type> {
        Some(match self {
            Topic::Vehicles => &schema::VEHICLES,
            Topic::World => &schema::SCENE_UPDATE,
            Topic::Points | Topic::Cloud => &schema::POINT_CLOUD,
            Topic::Models => &schema::ABOUT,
            Topic::Poses => &schema::POSES_IN_FRAME,
            Topic::Twists => &schema::TWISTS,
            Topic::Log => &schema::LOG,
            Topic::Events => &schema::EVENT,
            Topic::Metrics => &schema::METRICS,
            Topic::Readings => &schema::READING,
            Topic::Packets => &schema::PACKET,
            Topic::Radio => &schema::RADIO,
            Topic::Links => &schema::LINKS,
            Topic::Wind => &schema::WIND,
            Topic::Images => &schema::RAW_IMAGE,
            Topic::Solids => return None,
        })
    }
}
