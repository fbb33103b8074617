//! Attitude and body rate against closed forms and conservation laws.

use crate::worlds::{floating, in_space, run, seconds};
use simbeeotic_kernel::SimTime;
use simbeeotic_physics::{BodyId, BodySpec, Motion, Physics};
use simbeeotic_units::{Angle, Attitude, glam::DVec3};

fn spinning(inertia: DVec3, w: DVec3) -> (Physics, BodyId) {
    let mut physics = in_space();
    let spec = BodySpec {
        inertia_kg_m2: inertia,
        w_flu: w,
        ..floating(DVec3::ZERO, DVec3::ZERO)
    };
    let id = physics.add(spec).unwrap();
    (physics, id)
}

fn angular_momentum(motion: &Motion, t: SimTime) -> DVec3 {
    let state = motion.at(t);
    state.world_from_body * (motion.inertia_kg_m2() * state.w_flu)
}

fn spin_energy(motion: &Motion, t: SimTime) -> f64 {
    let w = motion.rate(t);
    0.5 * (motion.inertia_kg_m2() * w * w).element_sum()
}

#[test]
fn a_constant_body_rate_turns_by_rate_times_time() {
    let w = DVec3::new(0.3, -1.1, 2.0);
    let (physics, id) = spinning(DVec3::splat(0.25), w);
    for s in [0.01, 0.1, 1.0, 10.0, 1000.0] {
        let axis = w.normalize();
        let expected = Attitude::about(axis, Angle::si(w.length() * s));
        let actual = Attitude::from_unit_quat(physics.motion(id).attitude(seconds(s)));
        assert!(actual.angle_to(expected).get() < 1e-12 * s.max(1.0));
        assert_eq!(physics.motion(id).rate(seconds(s)), w);
    }
}

#[test]
fn a_torque_about_a_principal_axis_spins_up_uniformly() {
    let (physics, id) = spinning(DVec3::new(0.125, 0.25, 0.25), DVec3::new(0.0, 0.5, 0.0));
    let mut motion = *physics.motion(id);
    motion
        .set_torque(SimTime::ZERO, DVec3::new(0.0, 0.5, 0.0))
        .unwrap();
    // 2 rad/s^2 on top of 0.5 rad/s.
    let s = 3.0;
    assert_eq!(
        motion.angular_acceleration(seconds(s)),
        DVec3::new(0.0, 2.0, 0.0)
    );
    assert!((motion.rate(seconds(s)).y - 6.5).abs() < 1e-12);
    let expected = Attitude::about(DVec3::Y, Angle::si(0.5 * s + s * s));
    assert!(
        Attitude::from_unit_quat(motion.attitude(seconds(s)))
            .angle_to(expected)
            .get()
            < 1e-12
    );
    // Stopped, it turns on evenly.
    motion.set_torque(seconds(s), DVec3::ZERO).unwrap();
    assert!((motion.rate(seconds(9.0)).y - 6.5).abs() < 1e-12);
}

#[test]
fn a_symmetric_top_precesses_as_its_closed_form_says() {
    // I = (A, A, C): w_z is constant, (w_x, w_y) turns at (C - A) / A w_z.
    let (a, c) = (0.25, 0.5);
    let w = DVec3::new(1.0, 0.0, 4.0);
    let (mut physics, id) = spinning(DVec3::new(a, a, c), w);
    run(&mut physics, seconds(20.0));
    let rate = (c - a) / a * w.z;
    for s in [20.0, 20.3, 21.0] {
        let (sin, cos) = libm::sincos(rate * s);
        let expected = DVec3::new(cos, sin, 4.0);
        assert!(physics.motion(id).rate(seconds(s)).distance(expected) < 1e-7);
    }
}

#[test]
fn torque_free_tumbling_keeps_energy_and_momentum_for_100_s() {
    let (mut physics, id) = spinning(DVec3::new(0.125, 0.25, 0.3125), DVec3::new(0.1, 5.0, 0.2));
    let start = *physics.motion(id);
    let (energy, momentum) = (
        spin_energy(&start, SimTime::ZERO),
        angular_momentum(&start, SimTime::ZERO),
    );
    for second in 1..=100 {
        let t = SimTime::from_secs(second);
        run(&mut physics, t);
        let motion = physics.motion(id);
        assert!((spin_energy(motion, t) / energy - 1.0).abs() < 1e-7);
        assert!(angular_momentum(motion, t).distance(momentum) < 1e-7 * momentum.length());
        assert!((motion.attitude(t).length() - 1.0).abs() < 1e-12);
    }
    assert!(physics.tally().reviews > 10);
}

#[test]
fn tumbling_agrees_with_the_same_in_much_shorter_steps() {
    let (physics, id) = spinning(DVec3::new(0.125, 0.25, 0.3125), DVec3::new(0.5, 0.7, 0.9));
    let whole = Attitude::from_unit_quat(physics.motion(id).attitude(seconds(2.0)));
    let mut fine = *physics.motion(id);
    for step in 1..=20_000 {
        fine.advance(seconds(1e-4 * f64::from(step))).unwrap();
    }
    let error = whole.angle_to(Attitude::from_unit_quat(fine.attitude(seconds(2.0))));
    assert!(error.get() < 1e-8, "{error}");
}

#[test]
fn asking_changes_nothing() {
    let (physics, id) = spinning(DVec3::new(0.125, 0.25, 0.3125), DVec3::new(3.0, 4.0, 5.0));
    let mut asked = *physics.motion(id);
    asked
        .set_torque(SimTime::ZERO, DVec3::new(0.1, -0.2, 0.3))
        .unwrap();
    let alone = asked.at(seconds(0.7));
    for s in [0.1, 0.01, 0.35, 0.699_999_999] {
        let _ = asked.at(seconds(s));
    }
    assert_eq!(asked.at(seconds(0.7)), alone);
}

#[test]
fn an_impulse_off_centre_turns_and_pushes() {
    let (physics, id) = spinning(DVec3::splat(0.25), DVec3::ZERO);
    let mut motion = *physics.motion(id);
    motion
        .add_impulse_at(
            SimTime::ZERO,
            DVec3::new(0.0, 0.5, 0.0),
            DVec3::new(0.1, 0.0, 0.0),
        )
        .unwrap();
    assert!(
        motion
            .velocity(SimTime::ZERO)
            .distance(DVec3::new(0.0, 5.0, 0.0))
            < 1e-12
    );
    assert!(
        motion
            .rate(SimTime::ZERO)
            .distance(DVec3::new(0.0, 0.0, 0.2))
            < 1e-12
    );
}

#[test]
fn a_force_off_centre_is_a_force_and_a_torque() {
    let (physics, id) = spinning(DVec3::splat(0.25), DVec3::ZERO);
    let mut motion = *physics.motion(id);
    motion
        .add_force_at(
            SimTime::ZERO,
            DVec3::new(0.0, 0.5, 0.0),
            DVec3::new(0.5, 0.0, 0.0),
        )
        .unwrap();
    assert!(motion.torque().distance(DVec3::new(0.0, 0.0, 0.25)) < 1e-12);
    assert!((motion.rate(seconds(2.0)).z - 2.0).abs() < 1e-12);
    assert!(motion.acceleration().distance(DVec3::new(0.0, 5.0, 0.0)) < 1e-12);
}

#[test]
fn a_torque_that_never_ends_stays_finite() {
    let (mut physics, id) = spinning(DVec3::new(0.125, 0.25, 0.3125), DVec3::new(3.0, 4.0, 5.0));
    let mut motion = *physics.motion(id);
    motion
        .set_torque(SimTime::ZERO, DVec3::new(1e3, 2e3, -3e3))
        .unwrap();
    let far = motion.at(SimTime::MAX);
    assert!(far.w_flu.is_finite() && far.world_from_body.is_finite());
    physics.commit(id, SimTime::ZERO, motion);
    run(&mut physics, seconds(0.5));
    let state = physics.motion(id).at(seconds(0.5));
    assert!(state.w_flu.is_finite() && (state.world_from_body.length() - 1.0).abs() < 1e-9);
}
