//! What rays see, and that a filter can say so. In the original they passed through the hive, and through
//! every bee that did not collide.

use crate::swarm::{model, run_among, vehicle};
use simbeeotic_model::host::{Platform, Ray, Station};
use simbeeotic_model::physics::{BodySpec, Contacts, Kind, Mobility, Shape, group};
use simbeeotic_model::units::{Attitude, Length, Pose, Position, Time};
use simbeeotic_model::world::{
    HeightField, Obstacle, Patch, Person, PersonShape, Slab, Structure, StructureShape, Terrain,
    World,
};
use simbeeotic_model::{Behavior, BuildError, Kit, ModelPlan, SeesWhat, Thing, behavior, params};

/// None.
#[params]
#[derive(Default)]
struct NoParams {}

/// One thing of each kind stands every ten metres to the east.
const ROW: [Kind; 9] = [
    Kind::Ground,
    Kind::Terrain,
    Kind::Obstacle,
    Kind::Structure,
    Kind::Flower,
    Kind::Person,
    Kind::Vehicle,
    Kind::Station,
    Kind::Ghost,
];

fn x_of(kind: Kind) -> f64 {
    10.0 * kind as u8 as f64
}

fn down_on(kind: Kind) -> Ray {
    Ray {
        origin: Position::from_xyz(x_of(kind), 0.0, 20.0),
        direction: [0.0, 0.0, -1.0],
        range: Length::si(100.0),
    }
}

fn world() -> World {
    let at = |kind: Kind| Position::from_xyz(x_of(kind), 0.0, 0.0);
    let metre = Length::si(1.0);
    let terrain = Terrain {
        position: at(Kind::Terrain),
        ..Terrain::new(HeightField {
            length: metre,
            width: metre,
            heights: vec![vec![metre; 2]; 2],
            ..HeightField::default()
        })
    };
    World {
        terrain: Some(terrain),
        obstacles: vec![Obstacle {
            position: at(Kind::Obstacle),
            ..Obstacle::default()
        }],
        structures: vec![Structure {
            position: at(Kind::Structure) - Position::from_xyz(0.5, 0.5, 0.0),
            shape: StructureShape::Surface(Slab::default()),
            ..Structure::default()
        }],
        patches: vec![Patch {
            center: at(Kind::Flower),
            radius: metre,
            ..Patch::default()
        }],
        approximate_patches: true,
        people: vec![Person {
            position: at(Kind::Person),
            shape: PersonShape::Man {
                width: metre,
                height: metre,
            },
            ..Person::default()
        }],
        ..World::default()
    }
}

/// What is moved from outside, touches nothing and is in no group.
#[behavior("test-seen-ghost", host = Station)]
struct Ghost;

impl Behavior<Station> for Ghost {
    type Params = NoParams;

    fn build(_: NoParams, _: &mut Kit<Self, Station>) -> Result<Self, BuildError> {
        Ok(Self)
    }

    fn body(_: &NoParams) -> Option<BodySpec> {
        Some(BodySpec {
            mobility: Mobility::Driven,
            contacts: Contacts::None,
            group: group::NONE,
            ..BodySpec::new(Shape::Sphere { radius_m: 0.5 }, 1.0)
        })
    }
}

/// Looks down on each thing of the row, with every filter.
#[behavior("test-looks", host = Station)]
struct Looks;

impl Behavior<Station> for Looks {
    type Params = NoParams;

    fn build(_: NoParams, kit: &mut Kit<Self, Station>) -> Result<Self, BuildError> {
        kit.once(Time::from_secs(0.5), Self::look);
        Ok(Self)
    }

    fn body(_: &NoParams) -> Option<BodySpec> {
        Some(BodySpec {
            mobility: Mobility::Fixed,
            ..BodySpec::new(Shape::Sphere { radius_m: 0.1 }, 1.0)
        })
    }
}

impl Looks {
    fn look(&mut self, body: &mut Platform<'_>) {
        let rays = ROW.map(down_on);
        let seen = body.cast_rays(&rays);
        for (kind, seen) in ROW.into_iter().zip(&seen) {
            let seen = seen.expect("something is there");
            assert_eq!(seen.kind, kind, "{seen:?}");
            assert_eq!(seen.thing == Thing::Ground, kind == Kind::Ground);
            let is_model = kind >= Kind::Vehicle;
            assert_eq!(seen.thing.model().is_some(), is_model, "{seen:?}");
        }
        assert_eq!(seen, body.cast_rays_seeing(&rays, SeesWhat::EVERYTHING));

        for wanted in ROW {
            let seen = body.cast_rays_seeing(&rays, SeesWhat::only(&[wanted]));
            for (kind, seen) in ROW.into_iter().zip(seen) {
                let found = seen.map(|seen| seen.kind);
                // The plane of the ground is below all of them.
                let expected = kind == wanted || wanted == Kind::Ground;
                assert_eq!(found, expected.then_some(wanted), "{wanted:?} at {kind:?}");
            }
        }
        body.end_run("looked");
    }
}

#[test]
fn rays_see_everything_hive_and_ghosts_and_bees_without_contacts_too_and_by_kind() {
    let at = |name: &str, behavior: &str, kind: Kind| {
        let start = Position::from_xyz(x_of(kind), 0.0, 1.0);
        ModelPlan {
            start: Pose::new(start, Attitude::IDENTITY),
            ..model(name, behavior)
        }
    };
    let still = [("contacts", "none")];
    let x = x_of(Kind::Vehicle);
    let hovers = [("hover", "true")];
    let bee = vehicle("bee", "inert-bee", &hovers, &still, [x, 0.0, 1.0]);
    let plans = vec![
        ModelPlan {
            start: Pose::new(Position::from_xyz(0.0, 5.0, 5.0), Attitude::IDENTITY),
            ..model("looks", "test-looks")
        },
        bee,
        at("hive", "simple-hive", Kind::Station),
        at("ghost", "test-seen-ghost", Kind::Ghost),
    ];
    let outcome = run_among(world(), plans, 2).run();
    assert!(outcome.error.is_none(), "{:?}", outcome.error);
    assert_eq!(outcome.summary.ended, "looked");
}
