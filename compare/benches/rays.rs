//! Rays: from beside a body into any direction, 20 m far, among balls of 0.1 m radius, one in 8 m^3, of
//! which each flies its own way. Rapier's query pipeline knows where the bodies stood at its last step,
//! and is given the best of it: a step just now. Ours looks at where they are at the ray's time, half
//! way from one listing of who is near whom to the next.
//!
//! Told are rays for each second of processor time, the most of several turns, and how many rays meet
//! the same body at the same distance: that is what makes the two comparable.
//!
//! `cargo bench --bench rays -- 1000 10000` for other numbers of bodies.

use compare::{Dice, least, numbers, on_one_thread, one_per_8_m3, time_of};
use rapier3d::prelude as rapier;
use simbeeotic_kernel::SimTime;
use simbeeotic_physics::{BodySpec, Config, Physics, Ray, Sees, Shape};
use simbeeotic_units::glam::DVec3;

const RADIUS_M: f64 = 0.1;
const RANGE_M: f64 = 20.0;
const RAYS: usize = 20_000;
const TURNS: usize = 5;
/// When the rays are cast.
const T: SimTime = SimTime::from_millis(50);

/// What a ray meets: which body, how far away.
type Met = Option<(usize, f64)>;

fn vector(v: DVec3) -> rapier::Vector {
    rapier::Vector::new(v.x as f32, v.y as f32, v.z as f32)
}

fn main() {
    on_one_thread();
    println!("rays of {RANGE_M} m, millions in a second of processor time");
    println!(
        "{:>8} {:>12} {:>12} {:>8} {:>8} {:>8}",
        "bodies", "Rapier", "ours", "ratio", "hits", "alike"
    );
    for count in numbers(&[1_000, 10_000, 100_000]) {
        let mut dice = Dice(1982);
        let places = one_per_8_m3(count, &mut dice);
        let ways: Vec<DVec3> = places.iter().map(|_| dice.vector(2.0)).collect();
        let then: Vec<DVec3> = (places.iter().zip(&ways))
            .map(|(place, way)| *place + *way * T.as_secs_f64())
            .collect();
        let rays = rays(&then, &mut dice);

        let mut world = rapier::PhysicsWorld::new();
        world.gravity = rapier::Vector::ZERO;
        let mut balls = Vec::new();
        for (place, way) in then.iter().zip(&ways) {
            let body = rapier::RigidBodyBuilder::dynamic()
                .translation(vector(*place))
                .linvel(vector(*way));
            let (_, ball) = world.insert(body, rapier::ColliderBuilder::ball(RADIUS_M as f32));
            balls.push(ball);
        }
        // A step of no time: Rapier sees the bodies where they are.
        world.integration_parameters.dt = 0.0;
        world.step();

        let mut physics = Physics::new(Config {
            ground: None,
            ..Config::default()
        });
        for (place, way) in places.iter().zip(&ways) {
            let ball = BodySpec::new(Shape::Sphere { radius_m: RADIUS_M }, 0.1);
            let ball = BodySpec {
                p_enu: *place,
                v_enu: *way,
                gravity: false,
                ..ball
            };
            physics.add(ball).expect("a ball is a body");
        }
        physics.settle(SimTime::ZERO);
        while let Some(next) = physics.next_time().filter(|next| *next <= T) {
            physics.advance(next, &mut Vec::new());
            physics.settle(next);
        }

        let (mut theirs, mut ours): (Vec<Met>, Vec<Met>) = (Vec::new(), Vec::new());
        let mut times = [const { Vec::new() }; 2];
        for _ in 0..TURNS {
            theirs.clear();
            times[0].push(time_of(|| {
                let queries = world.query_pipeline();
                theirs.extend(rays.iter().map(|ray| {
                    let ray = rapier::Ray::new(vector(ray.origin_enu), vector(ray.direction_enu));
                    let (ball, distance) = queries.cast_ray(&ray, RANGE_M as f32, true)?;
                    Some((ball.into_raw_parts().0 as usize, f64::from(distance)))
                }));
            }));
            ours.clear();
            times[1].push(time_of(|| {
                ours.extend(rays.iter().map(|ray| {
                    let hit = physics.cast_ray(ray, T, &Sees::default());
                    let hit = hit.expect("the ray is finite")?;
                    Some((hit.body?.index(), hit.distance_m))
                }));
            }));
        }

        let index: std::collections::BTreeMap<usize, usize> = balls
            .iter()
            .enumerate()
            .map(|(id, ball)| (ball.into_raw_parts().0 as usize, id))
            .collect();
        let alike = |(theirs, ours): &(&Met, &Met)| match (theirs, ours) {
            (None, None) => true,
            (Some((ball, far)), Some((id, distance))) => {
                index.get(ball) == Some(id) && (far - distance).abs() < 1e-3
            }
            _ => false,
        };
        let same = theirs.iter().zip(&ours).filter(alike).count();
        let hits = ours.iter().flatten().count();
        let [rapier, ours] = times.map(|times| RAYS as f64 / least(&times) / 1e6);
        let percent = |n: usize| format!("{:.2}%", 100.0 * n as f64 / RAYS as f64);
        println!(
            "{count:>8} {rapier:>12.2} {ours:>12.2} {:>7.1}x {:>8} {:>8}",
            ours / rapier,
            percent(hits),
            percent(same)
        );
    }
}

/// Rays from just outside some body, as its sensors would cast them.
fn rays(places: &[DVec3], dice: &mut Dice) -> Vec<Ray> {
    (0..RAYS)
        .map(|_| {
            let from = places[dice.word() as usize % places.len()];
            let direction = loop {
                let direction = dice.vector(1.0);
                if (0.1..=1.0).contains(&direction.length()) {
                    break direction.normalize();
                }
            };
            Ray {
                origin_enu: from + direction * (RADIUS_M + 0.05),
                direction_enu: direction,
                range_m: RANGE_M,
            }
        })
        .collect()
}
