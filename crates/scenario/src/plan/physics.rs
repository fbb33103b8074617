//! `[physics]`: gravity and ground, and how faithfully contacts are simulated.

use super::section::read;
use simbeeotic_model::config::{Fault, Node};
use simbeeotic_model::physics::{self, Config, Material};
use simbeeotic_model::{choice, params};
use simbeeotic_units::{Acceleration, Time};
use simbeeotic_world::Ground;

/// Gravity and ground, and how faithfully contacts are simulated.
#[params]
pub struct PhysicsParams {
    /// Free fall, downwards.
    pub gravity: Acceleration,
    /// Whether the plane at height 0 is solid.
    pub ground: bool,
    /// Coulomb friction of the ground, 0 to 1000. If left out, that of the world's `[ground]`, or
    /// 0.5.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0, max = 1000.0))]
    pub friction: Option<f64>,
    /// Restitution of the ground: how much of a speed is left after a bounce, 0 to 1. If left out,
    /// that of the world's `[ground]`, or 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0, max = 1.0))]
    pub restitution: Option<f64>,
    /// What becomes of bodies that stay in touch.
    pub contact_model: ContactModel,
    /// Time between two steps of bodies in lasting contact (piles, slopes, what is pushed along),
    /// 0.1 ms to 20 ms. Shorter is stiffer and costs more.
    pub island_step: Time,
    /// How often each of these steps goes over the contacts, 1 to 64: more for higher stacks, and for
    /// heavy bodies upon light ones. The cost grows in proportion.
    #[schemars(range(min = 1, max = 64))]
    pub solver_iterations: usize,
    /// Time between two listings of who may meet whom, 1 ms to 1000 s: cost, never results.
    pub list_period: Time,
    /// Whether bodies that touch nobody are listed too, so that asking for neighbours and casting
    /// rays is quick among them: cost, never results.
    pub list_all: bool,
}

/// What becomes of bodies that stay in touch. Single impacts are the same in both: impulses at
/// computed times.
#[choice]
pub enum ContactModel {
    /// They are stepped together in a small world of their own (see `island_step`): they slide, stack,
    /// push one another and come to rest.
    Islands,
    /// Spheres bounce on in small impulses: cheaper for swarms whose bodies touch often and briefly,
    /// wrong for spheres that lie upon one another. Other shapes are stepped all the same.
    Impulses,
}

impl Default for PhysicsParams {
    fn default() -> Self {
        let config = Config::default();
        Self {
            gravity: config.gravity,
            ground: config.ground.is_some(),
            friction: None,
            restitution: None,
            contact_model: match config.contact_model {
                physics::ContactModel::Islands => ContactModel::Islands,
                physics::ContactModel::Impulses => ContactModel::Impulses,
            },
            island_step: config.island_step,
            solver_iterations: config.solver_iterations,
            list_period: config.list_period,
            list_all: config.list_all,
        }
    }
}

impl PhysicsParams {
    /// What physics is told. `ground` is what the world says of the ground's surface.
    fn config(&self, ground: &Ground) -> Config {
        let usual = Material::default();
        let friction = self.friction.or(ground.friction);
        let restitution = self.restitution.or(ground.restitution);
        Config {
            gravity: self.gravity,
            ground: self.ground.then_some(Material {
                friction: friction.unwrap_or(usual.friction),
                restitution: restitution.unwrap_or(usual.restitution),
            }),
            contact_model: match self.contact_model {
                ContactModel::Islands => physics::ContactModel::Islands,
                ContactModel::Impulses => physics::ContactModel::Impulses,
            },
            island_step: self.island_step,
            solver_iterations: self.solver_iterations,
            list_period: self.list_period,
            list_all: self.list_all,
        }
    }
}

/// Keys whose values [`Config::check`] looks at; its messages begin with them.
const CHECKED: [&str; 6] = [
    "gravity",
    "friction",
    "restitution",
    "island_step",
    "solver_iterations",
    "list_period",
];

/// Reads the section, if there is one. `ground` is what the world says of the ground's surface.
pub(super) fn physics(node: Option<&Node>, ground: &Ground, faults: &mut Vec<Fault>) -> Config {
    let Some(node) = node else {
        return PhysicsParams::default().config(ground);
    };
    let Some(params) = read::<PhysicsParams>(node, faults) else {
        return Config::default();
    };
    let config = params.config(ground);
    if let Err(error) = config.check() {
        let text = error.to_string();
        let key = CHECKED.into_iter().find(|key| text.starts_with(key));
        let value = key.and_then(|key| node.as_table().and_then(|t| t.get(key)));
        faults.push(Fault::error(value.map_or(node.span, |n| n.span), text));
    }
    config
}

#[cfg(test)]
mod tests {
    use super::super::testing::with_context;
    use super::*;

    fn config(text: &str, ground: &Ground) -> Result<Config, Vec<Fault>> {
        with_context(text, |root, cx| {
            Some(physics(Some(root), ground, &mut cx.faults))
        })
    }

    #[test]
    fn the_scenario_s_ground_goes_before_the_world_s() {
        let world = Ground {
            friction: Some(0.9),
            restitution: Some(0.3),
            ..Ground::default()
        };
        let ground = |text| config(text, &world).expect("good").ground.expect("ground");
        assert_eq!(ground("").friction, 0.9);
        let both = ground("friction = 0.1");
        assert_eq!((both.friction, both.restitution), (0.1, 0.3));
        let usual = config("", &Ground::default()).expect("good");
        assert_eq!(usual, Config::default());
        let none = config("ground = false", &world).expect("good");
        assert_eq!(none.ground, None);
    }

    #[test]
    fn every_value_out_of_range_is_found_at_its_place() {
        for (text, value, range) in [
            ("contact_model = \"events\"", "\"events\"", "unknown choice"),
            ("gravity = \"-1 m/s^2\"", "\"-1 m/s^2\"", "between 0 and"),
            ("friction = -0.5", "-0.5", "between 0 and 1000"),
            ("restitution = 1.5", "1.5", "between 0 and 1"),
            (
                "island_step = \"1 s\"",
                "\"1 s\"",
                "between 0.0001 and 0.02",
            ),
            ("solver_iterations = 0", "0", "between 1 and 64"),
            ("list_period = \"0 s\"", "\"0 s\"", "between 0.001 and 1000"),
        ] {
            let faults = config(text, &Ground::default()).expect_err(text);
            let span = faults[0].span.expect("a place");
            assert_eq!(&text[span.start..span.end], value);
            assert!(faults[0].message.contains(range), "{}", faults[0].message);
        }
    }
}
