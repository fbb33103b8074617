//! What is there: ground, obstacles, structures, flowers, people, weather.
//!
//! A [`World`] is plain data. It says where things stand, how large they are, what colour they
//! have; it does not move, and nothing in it knows of bodies, radios or files. `World::default()`
//! is an empty plane. Those who need geometry ask for [`World::objects`]: every object as a few
//! primitive [`Solid`]s with a pose, whatever it was called in the file.
//!
//! ```
//! use simbeeotic_world::{Obstacle, ObstacleShape, World};
//! use simbeeotic_units::{Length, Position};
//!
//! let mut world = World::default();
//! world.obstacles.push(Obstacle {
//!     position: Position::new(Length::si(4.0), Length::si(0.0), Length::si(0.0)),
//!     shape: ObstacleShape::Cylinder { diameter: Length::si(0.5), height: Length::si(2.0) },
//!     ..Obstacle::default()
//! });
//! assert!(world.check().is_empty());
//! assert_eq!(world.objects(0).len(), 1);
//! ```
//!
//! Frame: the world frame is ENU, `x` east, `y` north, `z` up; the ground is the plane `z = 0`.
//! A *length* runs along `x`, a *width* along `y`, a *height* along `z`, before rotation.
//! A *rotation* is about `z`, counter-clockwise seen from above.
//!
//! Reading order: [`world`] (the whole), [`look`] (colour, texture, metadata), [`obstacle`],
//! [`structure`], [`flower`], [`person`], [`terrain`] (what stands in it), [`mesh`] (shapes of points),
//! [`surface`] and [`material`] (how it feels, what it is made of), [`spawn`] (where to start, places
//! with a name), [`solid`] (the primitives), [`within`] (what is near), [`check`] (what cannot be),
//! [`spelling`] (what files may say in two ways), [`weather`] (the air), [`light`],
//! [`plume`] and [`puff`] (lamps and gases), [`field`] (what there is of them at a place), [`generate`]
//! (worlds by rule).

pub mod check;
mod cut;
pub mod field;
pub mod flower;
pub mod gas;
pub mod generate;
pub mod light;
pub mod look;
pub mod material;
pub mod mesh;
pub mod obstacle;
pub mod person;
pub mod plume;
pub mod puff;
pub mod solid;
pub mod spawn;
pub mod spelling;
pub mod structure;
pub mod surface;
pub mod terrain;
pub mod weather;
pub mod within;
pub mod world;

pub use check::WorldError;
pub use field::{GasField, LightField, ScalarField};
pub use flower::{Flower, FlowerShape, Patch};
pub use gas::Gases;
pub use light::{Beam, Light};
pub use look::{Color, ColorError, Meta, Texture};
pub use material::{Dielectric, LossRow, Material};
pub use mesh::{Hull, Mesh, UpAxis};
pub use obstacle::{Obstacle, ObstaclePart, ObstacleShape};
pub use person::{Person, PersonShape};
pub use plume::{Source, Stability};
pub use puff::Puffs;
pub use solid::{Object, ObjectId, ObjectKind, Solid, SolidShape};
pub use spawn::{Place, Spawn, SpawnPose, SpawnShape};
pub use structure::{Door, Slab, Structure, StructureShape, Trap, Wall, Window};
pub use surface::Surface;
pub use terrain::{HeightField, Terrain};
pub use weather::{Calm, Weather};
pub use world::{Ground, World};
