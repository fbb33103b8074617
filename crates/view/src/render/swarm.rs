//! What moves: vehicles, their trails, links and packets, as triangles.

use super::air::Link;
use super::beams::Line;
use super::glyph::{self, Glyph};
use super::motion::{Instant, Past};
use super::painter::{Stand, joined};
use super::solid::{Facet, facets, turn_of};
use super::triangle::Batch;
use super::wind;
use rayon::prelude::*;
use simbeeotic_record::Vehicle;
use simbeeotic_record::stage::Piece;
use simbeeotic_units::glam::{DVec3, Vec3};
use simbeeotic_units::math;
use std::collections::VecDeque;
use std::sync::Arc;

/// Vehicles whose triangles are made by one thread at a time.
const SHARE: usize = 128;
/// Parts of trails that a picture has at most.
const PARTS_MAX: usize = 400_000;
/// How wide trails and links are, pixels.
const TRAIL_PX: f32 = 1.7;
const LINK_PX: f32 = 1.5;
/// Rays of sensors, and where they meet something.
const BEAM_PX: f32 = 1.2;
const DOT_PX: f32 = 2.4;
/// The least radius of one that is drawn as its body, pixels of a picture that is 720 high.
pub(super) const BODY_LEAST_PX: f32 = 3.5;

/// How one vehicle is drawn, as far as that stays the same.
pub(super) struct Figure {
    /// Whether it is drawn.
    pub(super) shown: bool,
    radius_m: f32,
    alpha: u8,
    /// Its surface in its body frame, with its own colour, if it is no flyer.
    body: Option<(Arc<[Facet]>, [u8; 4])>,
}

/// What a body is made of, and its surface.
type Surface = (Arc<[Piece]>, Arc<[Facet]>);

impl Figure {
    /// The figures of vehicles; those that look alike share their surface.
    pub(super) fn all(vehicles: &[Vehicle], shown: &[bool]) -> Vec<Self> {
        let mut known: Vec<Surface> = Vec::new();
        let figure = |(vehicle, shown): (&Vehicle, &bool)| {
            let body = body_colour(vehicle).map(|colour| {
                let found = known.iter().find(|(pieces, _)| **pieces == *vehicle.pieces);
                let surface = match found {
                    Some((_, surface)) => Arc::clone(surface),
                    None => {
                        let surface: Arc<[Facet]> = surface(&vehicle.pieces).into();
                        known.push((Arc::clone(&vehicle.pieces), Arc::clone(&surface)));
                        surface
                    }
                };
                (surface, colour)
            });
            Self {
                shown: *shown,
                radius_m: vehicle.radius_m.clamp(0.0, 1e4) as f32,
                alpha: if vehicle.role == "ghost" { 120 } else { 255 },
                body,
            }
        };
        vehicles.iter().zip(shown).map(figure).collect()
    }

    /// Whether it is drawn as one that flies.
    pub(super) fn flies(&self) -> bool {
        self.body.is_none()
    }
}

/// Vehicles of this radius are drawn as their bodies, m.
const LARGE_M: f64 = 1.0;

/// The colour of one that is drawn as its recorded body; `None`: it is drawn as one that flies.
fn body_colour(vehicle: &Vehicle) -> Option<[u8; 4]> {
    let own = vehicle.role == "station" || vehicle.radius_m >= LARGE_M;
    (own && !vehicle.pieces.is_empty()).then_some(match vehicle.color {
        [_, _, _, 0] => [0xb0, 0xb4, 0xba, 255],
        colour => colour,
    })
}

fn surface(pieces: &[Piece]) -> Vec<Facet> {
    let turned = |piece: &Piece| {
        let (turn, place) = (turn_of(piece), DVec3::from(piece.position_m));
        let facets = facets(&piece.form, 24).into_iter();
        let facets = facets.map(move |facet| Facet {
            corners: facet
                .corners
                .map(|c| (turn * c.as_dvec3() + place).as_vec3()),
            normals: facet.normals.map(|n| (turn * n.as_dvec3()).as_vec3()),
        });
        facets.collect::<Vec<_>>()
    };
    pieces.iter().flat_map(turned).collect()
}

/// Everything that moves, at one instant.
pub(super) struct Swarm<'a> {
    pub(super) instant: &'a Instant,
    pub(super) figures: &'a [Figure],
    pub(super) colours: &'a [[u8; 3]],
    /// Whether bodies have these colours too, and not their own.
    pub(super) by_kind: bool,
    /// The smallest radius of a vehicle, pixels.
    pub(super) least_px: f32,
    /// The same of one that is drawn as its body.
    pub(super) body_least_px: f32,
    /// Whether the plane `z = 0` takes shadows.
    pub(super) plane: bool,
    /// Where they were, the oldest first, and how long a trail is, s.
    pub(super) past: &'a VecDeque<Past>,
    pub(super) present: &'a [Past],
    pub(super) trail_s: f64,
    /// Lines between two that hear each other.
    pub(super) links: &'a [Link],
    /// Packets on their way: from, to, how far they are, 0 to 1.
    pub(super) pulses: &'a [(usize, usize, f32)],
    /// What sensors look along.
    pub(super) beams: &'a [Line],
    /// Where the air is known and how it moves, as [`Wind`](simbeeotic_record::Wind) has it.
    pub(super) wind: &'a [[f32; 6]],
}

impl Swarm<'_> {
    pub(super) fn draw(&self, stand: &Stand<'_>) -> Batch {
        let count = self.figures.len().min(self.instant.places_m.len());
        let shares: Vec<usize> = (0..count).step_by(SHARE).collect();
        let parts: Vec<Batch> = shares
            .into_par_iter()
            .map(|first| {
                let mut batch = Batch::default();
                for at in first..(first + SHARE).min(count) {
                    self.vehicle(at, stand, &mut batch);
                }
                batch
            })
            .collect();
        let mut batch = joined(parts);
        for Line { ends_m, rgba, dot } in self.beams {
            let [from, to] = ends_m.map(|end| stand.projector.local(end));
            stand.line([from, to], [*rgba; 2], BEAM_PX, &mut batch.lines);
            if *dot {
                stand.disc(to, *rgba, DOT_PX, &mut batch.lines);
            }
        }
        // The more there are, the fainter each, and the thinner.
        let many = math::log10(self.links.len().max(1) as f64) as f32;
        let crowd = (1.2 - 0.15 * many).clamp(0.3, 1.0);
        let width = LINK_PX * if self.links.len() < 200 { 1.0 } else { 0.65 };
        for Link {
            ends,
            strong,
            share,
        } in self.links
        {
            let opacity = (0.16 + 0.84 * strong) * (0.35 + 0.65 * share.clamp(0.0, 1.0)) * crowd;
            let [r, g, b] = stand.theme.signal.colour((*strong).into());
            let rgba = [[r, g, b, (255.0 * opacity) as u8]; 2];
            if let [Some(from), Some(to)] = ends.map(|end| self.local(end, stand)) {
                stand.line([from, to], rgba, width, &mut batch.lines);
            }
        }
        for (from, to, share) in self.pulses {
            if let (Some(from), Some(to)) = (self.local(*from, stand), self.local(*to, stand)) {
                let at = from.lerp(to, *share);
                let alpha = (255.0 * (1.0 - 0.6 * share)) as u8;
                stand.disc(at, [0xe0, 0x3c, 0x6e, alpha], 2.4, &mut batch.lines);
            }
        }
        wind::draw(self.wind, stand, &mut batch.lines);
        batch
    }

    fn local(&self, at: usize, stand: &Stand<'_>) -> Option<Vec3> {
        let place = self.instant.places_m.get(at)?;
        let drawn = self.figures.get(at).is_some_and(|figure| figure.shown);
        (drawn && place.is_finite()).then(|| stand.projector.local(*place))
    }

    fn vehicle(&self, at: usize, stand: &Stand<'_>, batch: &mut Batch) {
        let Some(place) = self.local(at, stand) else {
            return;
        };
        let figure = &self.figures[at];
        let turn = self.instant.turns[at];
        if let Some((surface, own)) = &figure.body {
            let colour = &match (self.by_kind, self.colours[at]) {
                (true, [r, g, b]) => [r, g, b, own[3]],
                (false, _) => *own,
            };
            let larger = self.larger(place, figure.radius_m, stand);
            for facet in surface.iter() {
                let corners = facet
                    .corners
                    .map(|c| place + larger * (turn * c.as_dvec3()).as_vec3());
                let rgba = facet.normals.map(|n| {
                    stand
                        .theme
                        .body_bytes(*colour, (turn * n.as_dvec3()).as_vec3())
                });
                let below = corners.map(|c| glyph::on_ground(c, stand.projector.origin_m));
                if let ([Some(a), Some(b), Some(c)], true) = (below, self.plane) {
                    stand
                        .projector
                        .triangle([a, b, c], rgba, &mut batch.shadows);
                }
                let into = match colour[3] {
                    255 => &mut batch.solid,
                    _ => &mut batch.glass,
                };
                stand.projector.triangle(corners, rgba, into);
            }
            return;
        }
        if self.trail_s > 0.0 {
            self.trail(at, place, stand, batch);
        }
        let axes = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| (turn * axis).as_vec3());
        let glyph = Glyph {
            place,
            axes,
            radius_m: figure.radius_m,
            rgb: self.colours[at],
            alpha: figure.alpha,
            least_px: self.least_px,
            fineness: stand.fineness,
            // From above and from the side, shadows apart from their bees would be so many spots.
            shadow: self.plane && !stand.projector.is_flat(),
        };
        glyph::draw(&glyph, &stand.projector, stand.theme, batch);
    }

    /// So many times as large as it is a body is drawn, so that it can be seen.
    fn larger(&self, place: Vec3, radius_m: f32, stand: &Stand<'_>) -> f32 {
        let Some((_, scale, _)) = stand.projector.place(place) else {
            return 1.0;
        };
        let least = self.body_least_px * stand.fineness;
        (least / (radius_m * scale).max(1e-6)).clamp(1.0, 1e4)
    }

    /// Where it came from, fading.
    fn trail(&self, at: usize, place: Vec3, stand: &Stand<'_>, batch: &mut Batch) {
        let now_s = self.instant.time_s;
        let points = self.past.len() + self.present.len();
        let stride = (points * self.figures.len()).div_ceil(PARTS_MAX).max(1);
        let [r, g, b] = self.colours[at];
        let ink = |time_s: f64| {
            let left = 1.0 - ((now_s - time_s) / self.trail_s).clamp(0.0, 1.0);
            [r, g, b, (215.0 * left) as u8]
        };
        let mut newer = (place, ink(now_s));
        let all = self.past.iter().chain(self.present).rev().enumerate();
        for (k, past) in all {
            if k % stride != 0 {
                continue;
            }
            let Some(older) = past.places_m.get(at).filter(|place| place.is_finite()) else {
                break;
            };
            let older = (stand.projector.local(*older), ink(past.time_s));
            stand.line(
                [older.0, newer.0],
                [older.1, newer.1],
                TRAIL_PX,
                &mut batch.lines,
            );
            newer = older;
        }
    }
}
