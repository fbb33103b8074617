//! Marks on a map of flights: where they start and end, who stays where it is, names, and what the marks mean.

use super::super::axes::Panel;
use super::super::flights::Flight;
use super::super::ground::{Ground, MarkKind, draw_mark};
use super::super::map::{Column, Names};
use super::super::sheet::{FAINT, Ink, SMALL, Sheet, WHITE};
use super::{Paints, Scene};

/// Of more flights the places where they start are not marked.
const STARTS_MAX: usize = 150;
/// Who stays where it is, and has no colour of its own.
const STATION: Ink = Ink::new([0x26, 0x2b, 0x33]);

/// A ring where a flight starts, a dot where it ends.
pub(super) fn ends(sheet: &mut Sheet, panel: &Panel, scene: &Scene, paints: &Paints) {
    let radius = match scene.moving.len() {
        0..=7 => 5.0,
        8..=30 => 4.0,
        31..=150 => 2.6,
        _ => 1.4,
    };
    for (place, flight) in scene.moving.iter().enumerate() {
        let mut known = flight.known();
        let Some(first) = known.next() else { continue };
        let last = known.last().unwrap_or(first);
        let ink = |(at, p): (usize, [f64; 3])| paints.ink(place, flight, at, p[2]);
        let at = |(_, [x, y, _]): (usize, [f64; 3])| panel.place(x, y);
        if scene.moving.len() <= STARTS_MAX {
            sheet.disc(at(first), radius, ink(first), 0.0);
            sheet.disc(at(first), radius - 1.3, WHITE, 0.0);
        }
        sheet.disc(
            at(last),
            radius,
            ink(last),
            if radius > 2.0 { 1.0 } else { 0.0 },
        );
    }
}

/// Squares for those that stay where they are.
pub(super) fn stations(sheet: &mut Sheet, panel: &Panel, scene: &Scene) {
    for [x, y] in scene.still.iter().filter_map(rest) {
        station(sheet, panel.place(x, y), scene.still.len());
    }
}

/// The square of one that stays where it is.
pub(in super::super) fn station(sheet: &mut Sheet, [x, y]: [f64; 2], count: usize) {
    let half = if count > 60 { 2.2 } else { 4.5 };
    let square = |half: f64| ([x - half, y - half], [x + half, y + half]);
    let (a, b) = square(half + 1.2);
    sheet.rectangle(a, b, WHITE);
    let (a, b) = square(half);
    sheet.rectangle(a, b, STATION);
}

pub(super) fn rest(flight: &Flight) -> Option<[f64; 2]> {
    flight.known().next().map(|(_, [x, y, _])| [x, y])
}

pub(super) fn names(
    sheet: &mut Sheet,
    panel: &Panel,
    scene: &Scene,
    ground: Option<&Ground>,
    most: usize,
) {
    let still = scene.still.iter().filter_map(|flight| {
        let [x, y] = rest(flight)?;
        Some((panel.place(x, y), flight.path.clone()))
    });
    let mut named: Vec<([f64; 2], String)> = still.collect();
    if named.len() > most {
        // Of many, those that are alone of their kind: the hive among the beacons.
        let group = |path: &str| {
            let of = scene.still.iter().find(|flight| flight.path == path);
            let group = of.map_or("", |flight| flight.group());
            scene.still.iter().filter(|f| f.group() == group).count()
        };
        named.retain(|(_, path)| group(path) == 1);
    }
    let marks = ground.map_or(&[][..], |ground| ground.marks.as_slice());
    let marks = marks.iter().filter(|mark| {
        mark.kind != MarkKind::Flower && mark.kind != MarkKind::Light && !mark.label.is_empty()
    });
    let marks: Vec<_> = marks.collect();
    if marks.len() + named.len() <= most {
        for mark in marks {
            let [x, y] = mark.place_m;
            named.push((panel.place(x, y), mark.label.clone()));
        }
    }
    let [left, top, right, bottom] = panel.edges;
    named.retain(|([x, y], _)| (left..=right).contains(x) && (top..=bottom).contains(y));
    let mut names = Names::around(panel.edges, named.iter().map(|(at, _)| *at));
    for (at, text) in &named {
        names.write(sheet, *at, text, SMALL, |_, _| 0.0);
    }
}

/// What the marks say, below the colours.
pub(super) fn legend<'g>(
    sheet: &mut Sheet,
    column: &mut Column,
    scenes: &[Scene],
    grounds: impl Iterator<Item = &'g Ground>,
) {
    if scenes.iter().any(|scene| !scene.moving.is_empty()) {
        if scenes.iter().any(|scene| scene.moving.len() <= STARTS_MAX) {
            column.mark(sheet, "start", |sheet, at| {
                sheet.disc(at, 4.5, FAINT, 0.0);
                sheet.disc(at, 3.2, WHITE, 0.0);
            });
        }
        column.mark(sheet, "end", |sheet, at| sheet.disc(at, 4.5, FAINT, 0.0));
    } else {
        column.note(sheet, &["nobody moved"]);
    }
    if scenes.iter().any(|scene| !scene.still.is_empty()) {
        column.mark(sheet, "at rest", |sheet, at| station(sheet, at, 1));
    }
    let marks: Vec<_> = grounds.flat_map(|ground| &ground.marks).collect();
    for (kind, text) in [
        (MarkKind::Flower, "flower"),
        (MarkKind::Person, "person"),
        (MarkKind::Light, "light"),
        (MarkKind::Source, "source of gas"),
    ] {
        if let Some(mark) = marks.iter().find(|mark| mark.kind == kind)
            && column.room() > 0
        {
            column.mark(sheet, text, |sheet, at| {
                draw_mark(sheet, at, kind, mark.ink, 25.0);
            });
        }
    }
}
