//! What things with a name cannot be: materials, areas, places, textures.

use super::{Faults, PLACE_M_MAX, SIZE_M_MAX};
use crate::look::{Texture, TextureError};
use crate::material::{BUILT_IN, LossRow, Material};
use crate::spawn::{Place, Spawn, SpawnShape, area, bounds, crossing};
use crate::world::World;
use simbeeotic_units::{Decibels, Length, did_you_mean};

/// A polygon that fills less than this part of the box around it is refused.
const LEAST_SHARE: f64 = 1e-3;

impl Faults<'_> {
    /// Names of materials, areas and places: each is there and its own.
    pub(super) fn names(&mut self, world: &World) {
        let materials = world.materials.iter().map(|m| m.name.as_str());
        self.named("material", materials);
        self.named("spawn", world.spawns.iter().map(|s| s.name.as_str()));
        self.named("place", world.places.iter().map(|p| p.name.as_str()));
    }

    fn named<'n>(&mut self, kind: &str, names: impl Iterator<Item = &'n str>) {
        let mut seen = Vec::new();
        for (i, name) in names.enumerate() {
            if name.is_empty() {
                let message = format!("a {kind} needs a name");
                self.fault(&format!("{kind}.{i}.name"), message);
            } else if seen.contains(&name) {
                let message = format!("a second {kind} called `{name}`");
                self.fault(&format!("{kind}.{i}.name"), message);
            }
            seen.push(name);
        }
    }

    pub(super) fn material(&mut self, material: &Material) {
        self.feel(material.friction, material.restitution);
        self.loss("loss", material.loss.unwrap_or_default());
        self.loss(
            "loss_per_metre",
            material.loss_per_metre.unwrap_or_default(),
        );
        let numbers = material.loss.is_some() || material.loss_per_metre.is_some();
        if numbers && !material.table.is_empty() {
            let message =
                "`table` says both losses by frequency: `loss` and `loss_per_metre` go there";
            self.fault("table", message.into());
        }
        self.within("table", |f| f.rows(&material.table));
        let Some(slab) = material.slab else { return };
        self.within("slab", |f| {
            if !(slab.a >= 1.0 && slab.a.is_finite()) {
                let message = format!("a relative permittivity is 1 or more, not {}", slab.a);
                f.fault("a", message);
            }
            if !(slab.c >= 0.0 && slab.c.is_finite()) {
                f.fault(
                    "c",
                    format!("a conductivity is not negative, as {} is", slab.c),
                );
            }
            for (key, exponent) in [("b", slab.b), ("d", slab.d)] {
                // False for what is no number, too.
                let small = exponent.abs() <= 10.0;
                if !small {
                    let message = format!("an exponent lies between -10 and 10, not at {exponent}");
                    f.fault(key, message);
                }
            }
        });
    }

    fn rows(&mut self, rows: &[LossRow]) {
        let mut before_hz = 0.0;
        for (i, row) in rows.iter().enumerate() {
            self.within(&i.to_string(), |f| {
                let hz = row.frequency.get();
                if !(hz > before_hz && hz.is_finite()) {
                    let message = "frequencies are above 0 and rise from row to row";
                    f.fault("frequency", message.into());
                }
                before_hz = hz;
                f.loss("loss", row.loss);
                f.loss("loss_per_metre", row.loss_per_metre);
            });
        }
    }

    fn loss(&mut self, key: &str, loss: Decibels) {
        if !(loss.get() >= 0.0 && loss.is_finite()) {
            self.fault(key, format!("a loss must not be negative, as {loss} is"));
        }
    }

    /// The material that an object names, if it names one.
    pub(super) fn made_of(&mut self, material: Option<&str>) {
        let Some(name) = material else { return };
        if self.world.material(name).is_some() {
            return;
        }
        let own = self.world.materials.iter().map(|m| m.name.as_str());
        let known: Vec<&str> = own
            .chain(BUILT_IN.iter().map(|m| m.name.as_str()))
            .collect();
        let hint = match did_you_mean(name, known.iter().copied()) {
            Some(guess) => format!("did you mean `{guess}`?"),
            None => format!("known: `{}`", known.join("`, `")),
        };
        self.fault_with_help("material", format!("unknown material `{name}`"), hint);
    }

    pub(super) fn texture(&mut self, texture: Option<&Texture>) {
        if let Some(Err(TextureError { message, help })) = texture.map(Texture::check) {
            self.within("texture", |f| f.fault_with_help("builtin", message, help));
        }
    }

    pub(super) fn spawn(&mut self, spawn: &Spawn) {
        self.within("shape", |f| match &spawn.shape {
            SpawnShape::Box { from, size } => f.within("box", |f| {
                f.place("from", from.si(), PLACE_M_MAX);
                f.place("size", size.si(), SIZE_M_MAX);
                if size.si().min_element() < 0.0 {
                    f.fault("size", "the size of a box is not negative".into());
                }
            }),
            SpawnShape::Disc { center, radius } => f.within("disc", |f| {
                f.place("center", center.si(), PLACE_M_MAX);
                f.reach(*radius);
            }),
            SpawnShape::Ball { center, radius } => f.within("ball", |f| {
                f.place("center", center.si(), PLACE_M_MAX);
                f.reach(*radius);
            }),
            SpawnShape::Polygon { corners, height } => f.within("polygon", |f| {
                f.place("height", glam::DVec3::splat(height.get()), PLACE_M_MAX);
                f.polygon(corners);
            }),
            SpawnShape::Poses(poses) => {
                if poses.is_empty() {
                    f.fault("poses", "an area of no poses has no place to start".into());
                }
                for (i, pose) in poses.iter().enumerate() {
                    let key = format!("poses.{i}.position");
                    f.place(&key, pose.position.si(), PLACE_M_MAX);
                }
            }
        });
    }

    fn reach(&mut self, radius: Length) {
        self.at_least_zero("radius", radius);
        if radius.get() > SIZE_M_MAX {
            let most = Length::si(SIZE_M_MAX);
            let message = format!("`radius` is {radius}; at most {most} are possible");
            self.fault("radius", message);
        }
    }

    fn polygon(&mut self, corners: &[[Length; 2]]) {
        let before = self.found.len();
        for (i, [x, y]) in corners.iter().enumerate() {
            let place = glam::DVec3::new(x.get(), y.get(), 0.0);
            self.place(&format!("corners.{i}"), place, PLACE_M_MAX);
        }
        if corners.len() < 3 {
            let message = format!("a polygon has three corners or more, not {}", corners.len());
            self.fault("corners", message);
        } else if self.found.len() == before {
            let corners: Vec<[f64; 2]> = corners.iter().map(|c| c.map(Length::get)).collect();
            let (low, high) = bounds(&corners);
            let boxed = (high[0] - low[0]) * (high[1] - low[1]);
            // False for no area at all, too.
            let wide = area(&corners) > LEAST_SHARE * boxed;
            if let Some([one, other]) = crossing(&corners) {
                let message = format!(
                    "this polygon's sides cross: those from its corners {one} and {other}, counted from 0"
                );
                self.fault("corners", message);
            } else if !wide {
                let message = "this polygon has no area, or almost none";
                self.fault("corners", message.into());
            }
        }
    }

    pub(super) fn named_place(&mut self, place: &Place) {
        self.place("position", place.position.si(), PLACE_M_MAX);
        self.at_least_zero("radius", place.radius);
    }
}

#[cfg(test)]
mod tests {
    use crate::*;
    use simbeeotic_units::{Decibels, Frequency, Length, Position};

    fn faults(world: &World) -> Vec<(String, String)> {
        let all = world.check().into_iter();
        all.map(|e| (e.path, e.help.unwrap_or_default())).collect()
    }

    fn paths(world: &World) -> Vec<String> {
        faults(world).into_iter().map(|(path, _)| path).collect()
    }

    #[test]
    fn an_unknown_material_is_guessed_at() {
        let world = World {
            structures: vec![Structure {
                material: Some("brik".into()),
                ..Structure::default()
            }],
            people: vec![Person {
                material: Some("human-body".into()),
                ..Person::default()
            }],
            ..World::default()
        };
        let guess = "did you mean `brick`?".to_owned();
        assert_eq!(faults(&world), [("structure.0.material".into(), guess)]);
    }

    #[test]
    fn materials_have_their_ranges() {
        let row = |mhz: f64, loss: f64| LossRow {
            frequency: Frequency::from_megahertz(mhz),
            loss: Decibels::from_db(loss),
            loss_per_metre: Decibels::ZERO,
        };
        let world = World {
            materials: vec![
                Material {
                    name: "felt".into(),
                    friction: Some(-1.0),
                    loss: Some(Decibels::from_db(-3.0)),
                    table: vec![row(900.0, 1.0), row(900.0, f64::NAN)],
                    slab: Some(Dielectric {
                        a: 0.5,
                        b: f64::NAN,
                        c: -1.0,
                        d: 0.0,
                    }),
                    ..Material::default()
                },
                Material::default(),
                Material {
                    name: "felt".into(),
                    ..Material::default()
                },
            ],
            ..World::default()
        };
        assert_eq!(
            paths(&world),
            [
                "material.0.friction",
                "material.0.loss",
                "material.0.table",
                "material.0.table.1.frequency",
                "material.0.table.1.loss",
                "material.0.slab.a",
                "material.0.slab.c",
                "material.0.slab.b",
                "material.1.name",
                "material.2.name",
            ]
        );
    }

    #[test]
    fn areas_and_places_have_their_ranges() {
        let m = Length::si;
        let spawn = |name: &str, shape| Spawn {
            name: name.into(),
            shape,
            meta: Meta::new(),
        };
        let flat = [[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]].map(|c| c.map(m));
        let world = World {
            spawns: vec![
                spawn(
                    "a",
                    SpawnShape::Box {
                        from: Position::ZERO,
                        size: Position::from_xyz(1.0, -1.0, 0.0),
                    },
                ),
                spawn(
                    "a",
                    SpawnShape::Ball {
                        center: Position::ZERO,
                        radius: m(-1.0),
                    },
                ),
                spawn(
                    "c",
                    SpawnShape::Polygon {
                        corners: flat.to_vec(),
                        height: m(0.0),
                    },
                ),
                spawn("d", SpawnShape::Poses(Vec::new())),
            ],
            places: vec![Place {
                name: "dock".into(),
                position: Position::from_xyz(1e9, 0.0, 0.0),
                radius: m(-1.0),
                meta: Meta::new(),
            }],
            ..World::default()
        };
        assert_eq!(
            paths(&world),
            [
                "spawn.0.shape.box.size",
                "spawn.1.shape.ball.radius",
                "spawn.2.shape.polygon.corners",
                "spawn.3.shape.poses",
                "place.0.position",
                "place.0.radius",
                "spawn.1.name",
            ]
        );
    }

    #[test]
    fn a_polygon_whose_sides_cross_is_told_which() {
        let with = |corners: &[[f64; 2]]| World {
            spawns: vec![Spawn {
                name: "a".into(),
                shape: SpawnShape::Polygon {
                    corners: corners.iter().map(|c| c.map(Length::si)).collect(),
                    height: Length::ZERO,
                },
                meta: Meta::new(),
            }],
            ..World::default()
        };
        let said = |corners: &[[f64; 2]]| {
            let errors = with(corners).check().into_iter();
            errors.map(|e| e.message).collect::<Vec<_>>()
        };
        let wanted =
            "this polygon's sides cross: those from its corners 0 and 2, counted from 0".to_owned();
        let bow = [[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]];
        assert_eq!(said(&bow), std::slice::from_ref(&wanted));
        // Of unequal halves: its area by the formula is above 0.
        let bow = [[0.0, 0.0], [2.0, 2.0], [2.0, 0.0], [0.0, 1.0]];
        assert_eq!(said(&bow), [wanted]);
        // An L, and two triangles that touch at a corner, do not cross.
        let bent = [
            [0.0, 0.0],
            [2.0, 0.0],
            [2.0, 1.0],
            [1.0, 1.0],
            [1.0, 2.0],
            [0.0, 2.0],
        ];
        assert!(said(&bent).is_empty());
        let touching = [
            [0.0, 0.0],
            [2.0, 0.0],
            [1.0, 1.0],
            [2.0, 2.0],
            [0.0, 2.0],
            [1.0, 1.0],
        ];
        assert!(said(&touching).is_empty());
    }

    #[test]
    fn a_texture_that_does_not_come_with_the_program_is_refused() {
        let with = |name: &str| World {
            obstacles: vec![Obstacle {
                texture: Some(Texture::Builtin(name.into())),
                ..Obstacle::default()
            }],
            ..World::default()
        };
        assert!(with("brick_2").check().is_empty());
        assert!(with("metal").check().is_empty());
        let guess = "did you mean `brick`?".to_owned();
        let path = "obstacle.0.texture.builtin".to_owned();
        assert_eq!(faults(&with("brik_2")), [(path, guess)]);
    }
}
