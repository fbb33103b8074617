//! The world is solid: what bodies meet in it, when, and what they are told of it.

use crate::swarm::{model, run, run_among, setup, vehicle};
use glam::DVec3;
use simbeeotic_model::config::to_node;
use simbeeotic_model::host::{Platform, Station};
use simbeeotic_model::physics::{BodySpec, Material, Shape};
use simbeeotic_model::registry::{self, Kind, Make};
use simbeeotic_model::units::{Attitude, Length, Offset, Pose, Position};
use simbeeotic_model::world::{Door, Hull, Mesh, Surface, Wall};
use simbeeotic_model::world::{
    HeightField, Meta, Obstacle, ObstaclePart, ObstacleShape, Patch, Person, PersonShape,
    Structure, StructureShape, Terrain, World,
};
use simbeeotic_model::{
    Behavior, BuildError, Kit, ModelPlan, Setup, Simulation, Thing, Touch, behavior, params,
};
use simbeeotic_models::vehicle::outline::Outline;
use simbeeotic_models::vehicle::simple_bee::SimpleBeeParams;
use std::sync::Arc;

/// A ball of 10 cm without weight that flies to the east at 2 m/s, and ends the run with the words
/// for what it meets.
#[behavior("test-ball", host = Station)]
struct Ball;

/// None.
#[params]
#[derive(Default)]
struct NoParams {}

const RADIUS_M: f64 = 0.05;
const SPEED_M_S: f64 = 2.0;

impl Behavior<Station> for Ball {
    type Params = NoParams;

    fn build(_params: NoParams, _kit: &mut Kit<Self, Station>) -> Result<Self, BuildError> {
        Ok(Self)
    }

    fn body(_params: &NoParams) -> Option<BodySpec> {
        Some(BodySpec {
            v_enu: DVec3::new(SPEED_M_S, 0.0, 0.0),
            gravity: false,
            material: Material {
                friction: 0.0,
                restitution: 1.0,
            },
            ..BodySpec::new(Shape::Sphere { radius_m: RADIUS_M }, 0.1)
        })
    }

    fn on_contact(&mut self, touch: &Touch, ball: &mut Platform<'_>) {
        let what = match touch.other {
            Thing::Ground => "ground".to_owned(),
            Thing::Model(id) => ball.path_of(id).to_owned(),
            Thing::Object(id) => {
                let world = ball.world();
                let meta = world.meta_of(id).expect("it is in the world");
                let material = meta.get("material").map_or("", String::as_str);
                format!("{id} {}{material}", world.label_of(id))
            }
        };
        let (time, east) = (touch.time.as_secs_f64(), touch.normal[0]);
        ball.end_run(format!("{what} {time:.5} {east:.2}"));
    }
}

fn m(metres: f64) -> Length {
    Length::si(metres)
}

fn ball_at(from: [f64; 3]) -> ModelPlan {
    ModelPlan {
        start: Pose::new(
            Position::from_xyz(from[0], from[1], from[2]),
            Attitude::IDENTITY,
        ),
        ..model("ball", "test-ball")
    }
}

/// How the flight of a ball from a place in a world ends.
fn flight(world: World, from: [f64; 3]) -> String {
    let outcome = run_among(world, vec![ball_at(from)], 20).run();
    assert!(outcome.error.is_none(), "{:?}", outcome.error);
    outcome.summary.ended
}

fn obstacle(shape: ObstacleShape) -> World {
    let obstacle = Obstacle {
        position: Position::from_xyz(4.0, 0.0, 0.0),
        shape,
        ..Obstacle::default()
    };
    World {
        obstacles: vec![obstacle],
        ..World::default()
    }
}

/// The end of a flight that meets `what`, whose surface is `x` metres to the east, head on.
fn met(what: &str, x: f64) -> String {
    format!("{what} {:.5} 1.00", (x - RADIUS_M) / SPEED_M_S)
}

#[test]
fn a_ball_is_told_what_it_met_and_what_is_written_on_it() {
    let mut world = obstacle(ObstacleShape::default());
    world.obstacles.insert(
        0,
        Obstacle {
            position: Position::from_xyz(0.0, 50.0, 0.0),
            ..Obstacle::default()
        },
    );
    world.obstacles[1].label = "tower ".into();
    world.obstacles[1].meta = Meta::from([("material".into(), "brick".into())]);
    let end = flight(world, [0.0, 0.0, 0.5]);
    assert_eq!(end, met("obstacle.1 tower brick", 3.5));
}

#[test]
fn every_shape_is_met_where_its_surface_is() {
    let (radius, height) = (m(0.5), m(2.0));
    let cylinder = ObstacleShape::Cylinder {
        diameter: m(1.0),
        height,
    };
    assert_eq!(
        flight(obstacle(cylinder), [0.0, 0.0, 1.0]),
        met("obstacle.0 ", 3.5)
    );
    let capsule = ObstacleShape::Capsule { radius, height };
    assert_eq!(
        flight(obstacle(capsule), [0.0, 0.0, 1.0]),
        met("obstacle.0 ", 3.5)
    );
    let sphere = ObstacleShape::Sphere { radius: m(1.0) };
    assert_eq!(
        flight(obstacle(sphere), [0.0, 0.0, 1.0]),
        met("obstacle.0 ", 3.0)
    );
    let corner = |x, y, z| Offset::from_xyz(x, y, z);
    let tent = [
        corner(-1.0, -1.0, 0.0),
        corner(-1.0, 1.0, 0.0),
        corner(-1.0, -1.0, 2.0),
        corner(-1.0, 1.0, 2.0),
        corner(1.0, 0.0, 0.0),
    ];
    let hull = ObstacleShape::Hull(Hull {
        points: tent.into(),
        ..Hull::default()
    });
    assert_eq!(
        flight(obstacle(hull), [0.0, 0.0, 1.0]),
        met("obstacle.0 ", 3.0)
    );
    let mesh = ObstacleShape::Mesh(Mesh {
        points: tent[..4].into(),
        triangles: [[0, 1, 2], [3, 2, 1]].into(),
        ..Mesh::default()
    });
    assert_eq!(
        flight(obstacle(mesh), [0.0, 0.2, 1.0]),
        met("obstacle.0 ", 3.0)
    );
    let part = |x, shape| ObstaclePart {
        position: corner(x, 0.0, 1.0),
        attitude: Attitude::IDENTITY,
        shape,
    };
    let parts = ObstacleShape::Parts(vec![
        part(0.0, ObstacleShape::default()),
        part(-2.0, ObstacleShape::Sphere { radius }),
    ]);
    assert_eq!(
        flight(obstacle(parts), [0.0, 0.0, 1.0]),
        met("obstacle.0 ", 1.5)
    );
}

#[test]
fn a_cone_is_met_on_its_slope() {
    let cone = ObstacleShape::Cone {
        radius: m(1.0),
        height: m(1.0),
    };
    // A slope of 45 degrees: at half its height the surface is half a metre from the axis, and the
    // ball touches it a quarter turn below.
    let x = 4.0 - 0.5 - RADIUS_M * std::f64::consts::SQRT_2;
    let end = flight(obstacle(cone), [0.0, 0.0, 0.5]);
    assert_eq!(end, format!("obstacle.0  {:.5} 0.71", x / SPEED_M_S));
}

#[test]
fn a_door_is_open_and_the_wall_beside_it_is_not() {
    let wall = Structure {
        position: Position::from_xyz(4.0, -1.0, 0.0),
        // Turned to the north, it stands across the way.
        shape: StructureShape::Wall(Wall {
            length: m(4.0),
            width: m(0.1),
            height: m(3.0),
            rotation: simbeeotic_model::units::Angle::from_turns(0.25),
            doors: vec![Door {
                position: m(0.5),
                width: m(1.0),
                height: m(2.0),
            }],
            ..Wall::default()
        }),
        ..Structure::default()
    };
    let world = World {
        structures: vec![wall],
        ..World::default()
    };
    // Turned by 90 degrees, its width runs to the west: from 3.9 to 4.0 m.
    assert_eq!(flight(world.clone(), [0.0, 0.0, 1.0]), "end time");
    assert_eq!(
        flight(world.clone(), [0.0, 1.5, 1.0]),
        met("structure.0 ", 3.9)
    );
    assert_eq!(flight(world, [0.0, 0.0, 2.5]), met("structure.0 ", 3.9));
}

#[test]
fn people_flowers_and_hills_are_solid_too() {
    let man = Person {
        position: Position::from_xyz(4.0, 0.0, 0.0),
        shape: PersonShape::Man {
            width: m(1.3),
            height: m(2.0),
        },
        label: "Ada".into(),
        ..Person::default()
    };
    let people = World {
        people: vec![man],
        ..World::default()
    };
    assert_eq!(flight(people, [0.0, 0.0, 1.3]), met("person.0 Ada", 3.35));

    let meadow = World {
        patches: vec![Patch {
            center: Position::from_xyz(4.0, 0.0, 0.0),
            radius: m(0.7),
            ..Patch::default()
        }],
        approximate_patches: true,
        ..World::default()
    };
    let end = flight(meadow, [4.0, 0.0, 0.08]);
    assert_eq!(end, "end time", "it flies above the disc");
    let stem = World {
        patches: vec![Patch {
            center: Position::from_xyz(4.0, 0.0, 0.0),
            radius: m(1e-6),
            flowers_per_m2: 1e12,
            label: "daisy".into(),
            ..Patch::default()
        }],
        ..World::default()
    };
    let end = flight(stem, [0.0, 0.0, 0.1]);
    assert!(end.starts_with("flower.0."), "{end}");

    let heights = vec![vec![m(0.0), m(0.0), m(4.0)]; 3];
    let hill = Terrain::new(HeightField {
        length: m(16.0),
        width: m(10.0),
        heights,
        ..HeightField::default()
    });
    let world = World {
        terrain: Some(hill),
        ..World::default()
    };
    // The slope rises from x = 0 by one half: the ball touches it below its middle.
    let end = flight(world, [-4.0, 0.1, 2.0]);
    let rise = (1.0_f64 + 0.25).sqrt();
    let x = 4.0 - RADIUS_M * rise / 0.5;
    assert_eq!(end, format!("terrain.0  {:.5} 0.45", (x + 4.0) / SPEED_M_S));
}

#[test]
fn a_bee_lies_down_on_flowers_unless_it_touches_nothing() {
    let meadow = World {
        patches: vec![Patch {
            center: Position::from_xyz(0.0, 0.0, 4.0),
            radius: m(1.0),
            ..Patch::default()
        }],
        approximate_patches: true,
        ..World::default()
    };
    let touches = |contacts: &str| {
        let gear = [("contacts", contacts)];
        let bee = vehicle("bee", "inert-bee", &[], &gear, [0.0, 0.0, 5.0]);
        let mut run = run_among(meadow.clone(), vec![bee], 3);
        let outcome = run.run();
        assert!(outcome.error.is_none(), "{:?}", outcome.error);
        (
            outcome.summary.touches,
            run.pose("bee").expect("a body").position.up().metres(),
        )
    };
    let (solid, height) = touches("respond");
    assert!(solid > 0);
    assert!(
        (height - (4.02 + 0.05)).abs() < 1e-3,
        "it lies on the patch: {height}"
    );
    let (none, height) = touches("none");
    assert_eq!(none, 0);
    assert!(height < 0.0, "it falls for ever: {height}");
}

#[test]
fn what_is_out_of_reach_does_not_show_in_the_trace() {
    let trace = |world: World| {
        let outcome = run_among(world, vec![ball_at([0.0, 0.0, 1.0])], 1).run();
        assert!(outcome.error.is_none(), "{:?}", outcome.error);
        outcome.summary.trace_hash
    };
    let empty = trace(World::default());
    assert_eq!(trace(obstacle(ObstacleShape::default())), empty);
    let mut near = obstacle(ObstacleShape::default());
    near.obstacles[0].position = Position::from_xyz(1.5, 0.0, 0.5);
    assert_ne!(trace(near), empty, "a control: what is met does");
}

#[test]
fn a_surface_bounces_as_its_numbers_say() {
    let mut world = obstacle(ObstacleShape::default());
    world.obstacles[0].restitution = Some(0.25);
    assert_eq!(
        world.objects(1)[0].surface.friction,
        Surface::USUAL.friction
    );
    #[behavior("test-bouncing-ball", host = Station)]
    struct Bouncing;

    impl Behavior<Station> for Bouncing {
        type Params = NoParams;

        fn build(_: NoParams, _: &mut Kit<Self, Station>) -> Result<Self, BuildError> {
            Ok(Self)
        }

        fn body(params: &NoParams) -> Option<BodySpec> {
            Ball::body(params)
        }
    }

    let ball = ModelPlan {
        start: ball_at([0.0, 0.0, 0.5]).start,
        ..model("ball", "test-bouncing-ball")
    };
    let mut run = run_among(world, vec![ball], 3);
    assert!(run.run().error.is_none());
    // The geometric mean of 1 and 1/4.
    let speed = run.twist("ball").expect("a body").linear.east();
    assert!((speed.metres_per_second() + 1.0).abs() < 1e-9, "{speed}");
}

/// A bee that lets itself fall, of some shape.
fn falling(name: &str, params: &SimpleBeeParams, at: [f64; 3]) -> ModelPlan {
    let part = registry::find(Kind::Vehicle, "simple-bee").expect("the vehicle of the shelf");
    let Make::Vehicle(make) = part.make else {
        unreachable!("its kind is vehicle")
    };
    ModelPlan {
        vehicle: Some(make(&to_node(params)).expect("good parameters")),
        ..vehicle(name, "inert-bee", &[], &[], at)
    }
}

#[test]
fn a_flat_bee_lies_flat_where_it_stood() {
    let plank = Outline::Box {
        length: m(0.12),
        width: m(0.12),
        height: m(0.03),
    };
    let params = SimpleBeeParams {
        shape: Some(plank),
        ..SimpleBeeParams::default()
    };
    for height in [0.0, 0.5] {
        let plan = falling("bee", &params, [0.0, 0.0, height]);
        let mut run = run(vec![plan], 5);
        let outcome = run.run();
        assert!(outcome.error.is_none(), "{:?}", outcome.error);
        let pose = run.pose("bee").expect("a body");
        let z = pose.position.up().metres();
        assert!((z - 0.015).abs() < 2e-3, "from {height} m it lies at {z}");
        assert!(pose.attitude.up().z > 0.999, "{pose:?}");
    }
}

#[test]
fn bees_that_fall_on_a_heap_leave_the_same_trace_on_any_number_of_threads() {
    let mut world = obstacle(ObstacleShape::Cone {
        radius: m(2.0),
        height: m(1.0),
    });
    world.obstacles.push(Obstacle {
        position: Position::from_xyz(2.0, 0.0, 0.0),
        ..Obstacle::default()
    });
    let heap = |threads| {
        let params = SimpleBeeParams {
            bee_collisions: true,
            restitution: 0.3,
            ..SimpleBeeParams::default()
        };
        let bees = (0..120).map(|i| {
            let (x, y) = (f64::from(i % 10) * 0.3, f64::from(i / 10 % 4) * 0.3);
            let at = [2.0 + x, y - 0.5, 2.0 + f64::from(i / 40) * 0.4];
            falling(&format!("bee-{i}"), &params, at)
        });
        let setup = Setup {
            world: Arc::new(world.clone()),
            threads,
            ..setup(bees.collect(), 3)
        };
        let outcome = Simulation::new(setup)
            .expect("it can be put together")
            .run();
        assert!(outcome.error.is_none(), "{:?}", outcome.error);
        assert!(outcome.summary.touches > 120, "{}", outcome.summary.touches);
        outcome.summary.trace_seconds
    };
    let one = heap(1);
    assert_eq!(one, heap(2));
    assert_eq!(one, heap(3));
}
