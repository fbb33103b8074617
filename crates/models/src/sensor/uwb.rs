//! Ranging by ultra-wideband radio.

use super::bounds::{at_least_zero, place, reach};
use simbeeotic_model::check::in_range;
use simbeeotic_model::kernel::{ModelId, Stream};
use simbeeotic_model::physics::Kind;
use simbeeotic_model::units::{Decibels, Frequency, Length, Position, did_you_mean, math};
use simbeeotic_model::world::World;
use simbeeotic_model::{
    BuildError, Column, Reading, SeesWhat, Sensor, Truth, choice, params, sensor,
};

/// Measures distances to anchors at known places, and to other vehicles, by the time that a radio pulse takes.
///
/// In free sight a distance has a normal error of `sigma`. A thing in the way makes it longer and less
/// certain, or stops the pulse:
///
/// - A thing whose material is known to be a slab of permittivity `epsilon` and thickness `d` along the way
///   makes it `d (sqrt(epsilon) - 1)` longer; any other by `nlos_bias`.
/// - The materials' losses at `frequency` shorten the range: with `L` dB in all, pulses come through up to
///   `max_range 10^(-L / 20)`.
/// - A thing of unknown material stops a pulse with the probability `nlos_loss`. Ground and terrain stop
///   each.
/// - Behind `n` things the standard deviation is `sqrt(sigma^2 + n nlos_sigma^2)`.
///
/// The medium is not modelled: nobody waits for anybody's pulses. Other vehicles answer whether or not they
/// have such a sensor.
///
/// Source of the defaults: Decawave, DWM1000 data sheet, rev. 1.8: ranging to 10 cm on channel 5, 6.5 GHz
/// (not at hand; the P330 data sheet, section 6.4.1, says of the same chip that 10 cm are three sigma at
/// its best). What a thing of unknown material does is an assumption.
#[sensor("uwb")]
pub struct Uwb {
    params: UwbParams,
    /// Whose turn it is.
    next: usize,
}

/// One distance that an [`Uwb`] reads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UwbRange {
    /// To whom.
    pub to: UwbPeer,
    /// How far.
    pub distance: Length,
    /// Whether nothing is in between. A real sensor can guess it from the pulse's form.
    pub line_of_sight: bool,
}

/// Who answers an [`Uwb`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UwbPeer {
    /// The anchor of this number, from 0, in the scenario's order.
    Anchor(usize),
    /// Another model.
    Model(ModelId),
}

impl Reading for UwbRange {
    const COLUMNS: &'static [Column] = &[
        Column::new("anchor", "1"),
        Column::new("model", "1"),
        Column::new("distance", "m"),
        Column::new("line_of_sight", "1"),
    ];

    fn numbers(&self, to: &mut Vec<f64>) {
        to.extend(match self.to {
            UwbPeer::Anchor(anchor) => [anchor as f64, f64::NAN],
            UwbPeer::Model(model) => [f64::NAN, f64::from(model.0)],
        });
        to.push(self.distance.get());
        self.line_of_sight.numbers(to);
    }
}

/// Who is measured at a time.
#[choice]
pub enum UwbTurns {
    /// Everybody, at each reading.
    All,
    /// One at each reading, one after the other.
    One,
}

/// Parameters of [`Uwb`].
#[params]
pub struct UwbParams {
    /// Where the anchors are.
    pub anchors: Vec<Position>,
    /// More anchors: the names of places of the world (`[[place]]` in its file). They are numbered after those
    /// of `anchors`.
    pub places: Vec<String>,
    /// Whether distances to other vehicles are measured as well.
    pub vehicles: bool,
    /// Who is measured at each reading: `all`, or `one` after the other (anchors first).
    pub turns: UwbTurns,
    /// Who is farther does not answer. Above 0.
    pub max_range: Length,
    /// Standard deviation in free sight. 0 or more.
    pub sigma: Length,
    /// The frequency at which materials take from a pulse. 1 Hz to 1 THz.
    pub frequency: Frequency,
    /// How much longer a distance becomes by a thing of unknown material. 0 or more.
    pub nlos_bias: Length,
    /// What each thing in the way adds to the standard deviation, in squares. 0 or more.
    pub nlos_sigma: Length,
    /// The probability that a thing of unknown material stops the pulse. 0 to 1.
    pub nlos_loss: f64,
    /// What can be in the way.
    pub sees: SeesWhat,
}

impl Default for UwbParams {
    fn default() -> Self {
        Self {
            anchors: Vec::new(),
            places: Vec::new(),
            vehicles: false,
            turns: UwbTurns::All,
            max_range: Length::si(60.0),
            sigma: Length::from_centimetres(10.0),
            frequency: Frequency::from_gigahertz(6.4896),
            nlos_bias: Length::from_centimetres(10.0),
            nlos_sigma: Length::from_centimetres(10.0),
            nlos_loss: 0.1,
            sees: SeesWhat::EVERYTHING,
        }
    }
}

impl Sensor for Uwb {
    type Params = UwbParams;
    type Reading = Vec<UwbRange>;

    fn build(params: UwbParams) -> Result<Self, BuildError> {
        reach("max_range", params.max_range)?;
        at_least_zero("sigma", params.sigma)?;
        let (low, high) = (Frequency::si(1.0), Frequency::si(1e12));
        in_range("frequency", params.frequency, low..=high)?;
        at_least_zero("nlos_bias", params.nlos_bias)?;
        at_least_zero("nlos_sigma", params.nlos_sigma)?;
        in_range("nlos_loss", params.nlos_loss, 0.0..=1.0)?;
        for anchor in &params.anchors {
            place("anchors", *anchor)?;
        }
        if params.anchors.is_empty() && params.places.is_empty() && !params.vehicles {
            let message =
                "are none, nor `places`, and `vehicles` is false: nobody is to be measured";
            return Err(BuildError::parameter("anchors", message));
        }
        Ok(Self { params, next: 0 })
    }

    fn look_up(&mut self, world: &World) -> Result<(), BuildError> {
        for name in &self.params.places {
            let Some(place) = world.place(name) else {
                let known = world.places.iter().map(|place| &*place.name);
                let guess = did_you_mean(name, known.clone());
                let guess = guess.map(|guess| format!("; did you mean `{guess}`?"));
                let known: Vec<&str> = known.collect();
                let known = match known.is_empty() {
                    true => "which has none".to_owned(),
                    false => format!("which has {}", known.join(", ")),
                };
                let guess = guess.unwrap_or_default();
                let message =
                    format!("names `{name}`, which is no place of the world, {known}{guess}");
                return Err(BuildError::parameter("places", message));
            };
            super::bounds::place("places", place.position)?;
            self.params.anchors.push(place.position);
        }
        self.params.places.clear();
        Ok(())
    }

    fn ideal(&mut self, truth: &Truth<'_>) -> Vec<UwbRange> {
        let p = &self.params;
        let here = truth.sensor_pose().position;
        let mut peers: Vec<(UwbPeer, Position)> = p
            .anchors
            .iter()
            .copied()
            .enumerate()
            .map(|(number, place)| (UwbPeer::Anchor(number), place))
            .collect();
        if p.vehicles {
            // A little farther: the distance counts from the sensor and not from the host's middle.
            let reach = p.max_range + truth.mount().position.length();
            let others = truth.neighbors(reach).into_iter();
            let others = others.filter(|id| truth.kind_of(*id) == Some(Kind::Vehicle));
            peers.extend(
                others.filter_map(|id| Some((UwbPeer::Model(id), truth.pose_of(id)?.position))),
            );
        }
        if p.turns == UwbTurns::One && !peers.is_empty() {
            let turn = self.next % peers.len();
            self.next = turn + 1;
            peers = vec![peers[turn]];
        }
        let near = |(_, place): &(UwbPeer, Position)| here.distance(*place) <= p.max_range;
        let range = |(to, place): (UwbPeer, Position)| UwbRange {
            to,
            distance: here.distance(place),
            line_of_sight: truth.is_free(here, place, to.model(), p.sees),
        };
        peers.into_iter().filter(near).map(range).collect()
    }

    fn measure(
        &mut self,
        ideal: Vec<UwbRange>,
        truth: &Truth<'_>,
        rng: &mut Stream,
    ) -> Vec<UwbRange> {
        let p = &self.params;
        let mut read = Vec::with_capacity(ideal.len());
        for range in ideal {
            let Some(way) = self.way(truth, &range) else {
                continue;
            };
            let (free, each) = (p.sigma.get(), p.nlos_sigma.get());
            let error = (free * free + f64::from(way.things) * each * each).sqrt() * rng.normal();
            let reach = p.max_range * math::pow(10.0, -way.loss.get() / 20.0);
            let lucky = way.unknown == 0
                || rng.uniform() < math::pow(1.0 - p.nlos_loss, f64::from(way.unknown));
            if lucky && range.distance <= reach {
                let distance = range.distance + way.longer + Length::si(error);
                read.push(UwbRange {
                    distance: distance.max(Length::ZERO),
                    ..range
                });
            }
        }
        read
    }
}

impl UwbPeer {
    fn model(self) -> Option<ModelId> {
        match self {
            Self::Anchor(_) => None,
            Self::Model(id) => Some(id),
        }
    }
}

/// What a pulse meets on its way.
#[derive(Default)]
struct Way {
    things: u32,
    /// Of these, without a known material.
    unknown: u32,
    longer: Length,
    loss: Decibels,
}

impl Uwb {
    /// What is in the way of a pulse; `None` if it stops it.
    fn way(&self, truth: &Truth<'_>, range: &UwbRange) -> Option<Way> {
        let p = &self.params;
        if range.line_of_sight {
            return Some(Way::default());
        }
        let here = truth.sensor_pose().position;
        let place = match range.to {
            UwbPeer::Anchor(number) => self.params.anchors[number],
            UwbPeer::Model(id) => truth.pose_of(id)?.position,
        };
        let mut way = Way::default();
        for crossing in truth.crossings(here, place, range.to.model(), p.sees)? {
            way.things += 1;
            let object = crossing.thing.object();
            let material = object.and_then(|object| truth.world().material_of(object));
            let slab = material.and_then(|material| material.slab);
            way.longer += match slab {
                Some(slab) => crossing.thickness * (slab.permittivity(p.frequency).sqrt() - 1.0),
                None => p.nlos_bias,
            };
            match material {
                Some(material) => way.loss += material.loss(p.frequency, crossing.thickness),
                None => way.unknown += 1,
            }
        }
        Some(way)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sensor::scene::{block, still};
    use crate::trial::{Trial, assert_normal, refusal};
    use simbeeotic_model::Handle;
    use simbeeotic_model::units::{Angle, Attitude, Mount, Offset, Velocity, Yaw};
    use simbeeotic_model::world::{Dielectric, Material, Obstacle, Place, World};

    type Reader = Handle<Vec<UwbRange>>;

    const QUIET: [(&str, &str); 3] = [("sigma", "0 m"), ("nlos_sigma", "0 m"), ("nlos_loss", "0")];

    fn quiet(more: &[(&'static str, &'static str)]) -> Trial {
        let params: Vec<_> = QUIET.into_iter().chain(more.iter().copied()).collect();
        Trial::of("uwb", &params)
    }

    #[test]
    fn it_measures_to_anchors_from_where_it_sits_in_any_attitude() {
        let mut trial = quiet(&[(
            "anchors",
            "[[3 m, 0 m, 10 m], [0 m, 40 m, 10 m], [0 m, 0 m, 90 m]]",
        )]);
        trial.mount = Mount::new(Offset::from_xyz(0.0, 0.1, 0.0), Attitude::IDENTITY);
        trial.run(|bee, sensor: Reader| {
            bee.set_velocity(Velocity::from_xyz(3.0, 0.0, 0.0));
            for yaw in [0.0, 100.0] {
                bee.set_attitude(Attitude::from_yaw(Yaw::new(Angle::from_degrees(yaw))));
                let antenna = bee.position().si() + bee.attitude().left() * 0.1;
                let read = bee.read(sensor);
                // The third is out of range.
                let want = [[3.0, 0.0, 10.0], [0.0, 40.0, 10.0]];
                assert_eq!(read.len(), 2);
                for (number, (read, anchor)) in read.iter().zip(want).enumerate() {
                    let way =
                        (antenna - simbeeotic_model::units::glam::DVec3::from(anchor)).length();
                    assert_eq!(read.to, UwbPeer::Anchor(number));
                    assert!((read.distance.get() - way).abs() < 1e-12);
                    assert!(read.line_of_sight);
                }
            }
        });
    }

    #[test]
    fn each_wall_makes_the_way_longer_and_a_thick_one_counts_once() {
        let mut trial = quiet(&[
            ("anchors", "[[20 m, 0 m, 10.05 m]]"),
            ("nlos_bias", "30 cm"),
        ]);
        trial.world = World {
            obstacles: vec![
                block([5.0, 0.0, 0.0], [0.1, 10.0, 20.0]),
                block([10.0, 0.0, 0.0], [2.0, 10.0, 20.0]),
            ],
            ..World::default()
        };
        trial.run(|bee, sensor: Reader| {
            for (east, walls) in [(0.0, 2), (7.0, 1), (14.0, 0)] {
                bee.set_position(Position::from_xyz(east, 0.0, 10.05));
                let read = bee.read(sensor);
                let want = 20.0 - east + 0.3 * f64::from(walls);
                let off = read[0].distance.get() - want;
                assert!(off.abs() < 1e-9, "{read:?} for {want} m");
                assert_eq!(read[0].line_of_sight, walls == 0);
            }
        });
    }

    #[test]
    fn a_wall_of_known_material_costs_what_physics_says() {
        let wall = |material: &str, thick: f64| World {
            obstacles: vec![Obstacle {
                material: Some(material.to_owned()),
                ..block([10.0, 0.0, 0.0], [thick, 10.0, 20.0])
            }],
            materials: vec![Material {
                name: "slate".to_owned(),
                slab: Some(Dielectric {
                    a: 4.0,
                    b: 0.0,
                    c: 0.0,
                    d: 0.0,
                }),
                loss: Some(Decibels::si(6.0)),
                ..Material::default()
            }],
            ..World::default()
        };
        // 30 cm of a permittivity of 4 are 30 cm more of light's way. 6 dB and what the slab reflects leave
        // about half of 60 m.
        for (material, thick, east, longer) in [
            ("slate", 0.3, 20.0, Some(0.3)),
            ("slate", 0.02, 20.0, Some(0.02)),
            ("slate", 0.3, 45.0, None),
            ("metal", 0.01, 12.0, None),
        ] {
            let mut trial = quiet(&[(
                "anchors",
                "[[20 m, 0 m, 10.05 m], [12 m, 0 m, 10.05 m], [45 m, 0 m, 10.05 m]]",
            )]);
            trial.world = wall(material, thick);
            trial.run(move |bee, sensor: Reader| {
                bee.set_position(Position::from_xyz(0.0, 0.0, 10.05));
                let read = bee.read(sensor);
                let anchor = [20.0, 12.0, 45.0].iter().position(|at| *at == east);
                let to = UwbPeer::Anchor(anchor.expect("one of them"));
                let found = read.iter().find(|range| range.to == to);
                let found = found.map(|range| range.distance.get());
                match longer {
                    Some(longer) => {
                        let off = found.expect("it comes through") - east - longer;
                        assert!(off.abs() < 1e-6, "{material}, {thick} m: {off} m off");
                    }
                    None => assert_eq!(found, None, "{material}, {thick} m"),
                }
            });
        }
    }

    #[test]
    fn as_many_pulses_come_through_as_it_says() {
        let params = [
            ("anchors", "[[20 m, 0 m, 10.05 m]]"),
            ("sigma", "3 cm"),
            ("nlos_sigma", "4 cm"),
            ("nlos_bias", "0 m"),
            ("nlos_loss", "0.2"),
        ];
        let mut trial = Trial::of("uwb", &params);
        trial.world = World {
            obstacles: vec![block([10.0, 0.0, 0.0], [0.1, 10.0, 20.0])],
            ..World::default()
        };
        trial.run(|bee, sensor: Reader| {
            bee.set_position(Position::from_xyz(0.0, 0.0, 10.05));
            let n = 100_000;
            let read = (0..n).flat_map(|_| bee.read(sensor));
            let read: Vec<f64> = read.map(|range| range.distance.get()).collect();
            let share = read.len() as f64 / f64::from(n);
            assert!(
                (share - 0.8).abs() < 4.0 * (0.16 / f64::from(n)).sqrt(),
                "{share}"
            );
            assert_normal(&read, 20.0, 0.05);
            bee.set_position(Position::from_xyz(15.0, 0.0, 10.05));
            let read: Vec<f64> = (0..n).map(|_| bee.read(sensor)[0].distance.get()).collect();
            assert_normal(&read, 5.0, 0.03);
        });
    }

    #[test]
    fn places_of_the_world_are_anchors_and_unknown_ones_are_refused() {
        let mut trial = quiet(&[
            ("anchors", "[[0 m, 0 m, 12 m]]"),
            ("places", "[door, desk]"),
        ]);
        let place = |name: &str, east| Place {
            name: name.to_owned(),
            position: Position::from_xyz(east, 0.0, 10.05),
            radius: Length::ZERO,
            meta: Default::default(),
        };
        trial.world = World {
            places: vec![place("desk", 7.0), place("door", 3.0)],
            ..World::default()
        };
        trial.run(|bee, sensor: Reader| {
            bee.set_position(Position::from_xyz(0.0, 0.0, 10.05));
            let read = bee.read(sensor);
            let read: Vec<_> = read.iter().map(|r| (r.to, r.distance.get())).collect();
            let want = [(0, 1.95), (1, 3.0), (2, 7.0)];
            assert_eq!(read.len(), 3);
            for ((to, distance), (number, way)) in read.into_iter().zip(want) {
                assert_eq!(to, UwbPeer::Anchor(number));
                assert!((distance - way).abs() < 1e-9, "{distance} for {way}");
            }
        });
        let refusal = refusal("uwb", &[("places", "[door]")]).expect("no such place");
        assert!(
            refusal.contains("places") && refusal.contains("door"),
            "{refusal}"
        );
    }

    #[test]
    fn the_ground_stops_it() {
        let trial = quiet(&[("anchors", "[[0 m, 0 m, -1 m]]")]);
        trial.run(|bee, sensor: Reader| assert!(bee.read(sensor).is_empty()));
    }

    #[test]
    fn other_vehicles_answer_and_are_not_in_their_own_way() {
        let mut trial = quiet(&[("vehicles", "true"), ("max_range", "20 m")]);
        for (name, east) in [("near", 4.0), ("behind", 8.0), ("far", 30.0)] {
            trial.others.push(still(name, [east, 0.0, 10.0]));
        }
        trial.run(|bee, sensor: Reader| {
            let read = bee.read(sensor);
            let [near, behind] = read[..] else {
                panic!("{read:?}")
            };
            assert_eq!(
                near.to,
                UwbPeer::Model(bee.find("near").expect("it is there"))
            );
            assert!((near.distance.get() - 4.0).abs() < 1e-9 && near.line_of_sight);
            // The one in front is in the way of the other.
            assert!((behind.distance.get() - 8.1).abs() < 1e-9 && !behind.line_of_sight);
        });
    }

    #[test]
    fn one_after_the_other_has_its_turn() {
        let trial = quiet(&[
            (
                "anchors",
                "[[1 m, 0 m, 10 m], [2 m, 0 m, 10 m], [3 m, 0 m, 10 m]]",
            ),
            ("turns", "one"),
        ]);
        trial.run(|bee, sensor: Reader| {
            let read: Vec<UwbPeer> = (0..5).map(|_| bee.read(sensor)[0].to).collect();
            assert_eq!(read, [0, 1, 2, 0, 1].map(UwbPeer::Anchor));
        });
    }

    #[test]
    fn nonsense_is_refused_by_name() {
        for (key, text) in [
            ("max_range", "0 m"),
            ("sigma", "-1 m"),
            ("frequency", "0 Hz"),
            ("nlos_bias", "-1 m"),
            ("nlos_sigma", "-1 m"),
            ("nlos_loss", "1.5"),
            ("turns", "two"),
        ] {
            let refusal = refusal("uwb", &[("vehicles", "true"), (key, text)]).expect("refused");
            assert!(refusal.contains(key) || refusal.contains(text), "{refusal}");
        }
        let refusal = refusal("uwb", &[]).expect("nobody there");
        assert!(refusal.contains("anchors"), "{refusal}");
    }
}
