//! What the words of `render` mean.

use super::render_arguments::RenderOptions;
use super::{Failure, input, picture};
use simbeeotic_units::{Angle, AngularRate, did_you_mean};
use simbeeotic_view::render::{Choices, ColourBy, CutOpen, DRAWN_MAX, Fit, Side, View};

/// How pictures are taken. `still`: there is one only.
pub(super) fn choices(options: &RenderOptions, still: bool) -> Result<Choices, Failure> {
    let trail_s = match &options.picture.trails {
        Some(text) => input::time("--trails", text)?.get(),
        None => 0.0,
    };
    let size = size(&options.picture.size)?;
    // Finer as long as that is not too much for the memory.
    let pixels = u64::from(size[0]) * u64::from(size[1]);
    let own = match still {
        true if 4 * pixels <= DRAWN_MAX => 2,
        _ => 1,
    };
    let fineness = options.picture.fineness.unwrap_or(own);
    if !(1..=4).contains(&fineness) {
        return Err(Failure::input(format!("--fineness {fineness}: 1 to 4")));
    }
    Ok(Choices {
        size,
        fineness,
        dark: options.picture.dark && !options.picture.light,
        view: view(options)?,
        fit: fit(&options.camera.fit)?,
        models: options.picture.models.clone(),
        follow: options.camera.follow.clone(),
        zoom: positive("--zoom", options.camera.zoom, 1e4)?,
        field_of_view_rad: angle_within(
            "--field-of-view",
            &options.camera.field_of_view,
            [1.0, 150.0],
        )?,
        colour_by: ColourBy::named(&options.picture.colour_by),
        trail_s,
        labels: options.picture.labels,
        links: options.picture.links,
        packets: options.picture.packets,
        beams: options.picture.beams.clone(),
        wind: !options.picture.no_wind,
        cut_open: cut_open(&options.picture.cut_open)?,
        grid: !options.picture.no_grid,
        captions: !options.picture.plain,
        speed: positive("--speed", options.film.speed, 1e6)?,
    })
}

/// A number above 0.
pub(super) fn positive(option: &str, value: f64, most: f64) -> Result<f64, Failure> {
    // No row of three hundred digits.
    let said = match value.abs() {
        large if large >= 1e9 => format!("{value:e}"),
        _ => value.to_string(),
    };
    match value > 0.0 && value <= most {
        true => Ok(value),
        false => Err(Failure::input(format!(
            "{option} {said}: above 0, at most {most}"
        ))),
    }
}

fn size(text: &str) -> Result<[u32; 2], Failure> {
    let sides = text.split_once('x');
    let sides = sides.and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]));
    match sides {
        Some(sides) if sides.iter().all(|side| (16..=8192).contains(side)) => Ok(sides),
        _ => Err(Failure::input(format!(
            "--size {text}: width and height in pixels, 16 to 8192, such as 1280x720"
        ))),
    }
}

const VIEWS: [&str; 6] = ["top", "north", "south", "east", "west", "orbit"];

fn view(options: &RenderOptions) -> Result<View, Failure> {
    if let Some(eye) = &options.camera.eye {
        let eye_m = picture::place("--eye", eye)?;
        let at = options.camera.look_at.as_deref();
        let at_m = at
            .map(|text| picture::place("--look-at", text))
            .transpose()?;
        if at_m.is_some_and(|at| (at - eye_m).length() < 1e-6) {
            return Err(Failure::input(format!(
                "--eye and --look-at are the same place, {eye_m}: there is no direction between them"
            )));
        }
        return Ok(View::From { eye_m, at_m });
    }
    let side = match options.camera.view.as_str() {
        "top" => Side::Top,
        "north" => Side::North,
        "south" => Side::South,
        "east" => Side::East,
        "west" => Side::West,
        "orbit" => {
            let or = |text: &Option<String>, or: &str| text.clone().unwrap_or(or.to_owned());
            let bearing = or(&options.camera.bearing, "220 deg");
            let elevation = options.camera.elevation.as_deref();
            let elevation = elevation.map(|text| angle_within("--elevation", text, [-89.0, 89.0]));
            let turn = or(&options.camera.turn, "0 deg/s");
            let turn: AngularRate = turn
                .parse()
                .map_err(|e| Failure::input(format!("--turn: {e}")))?;
            return Ok(View::Orbit {
                bearing_rad: angle_within("--bearing", &bearing, [-360.0, 360.0])?,
                elevation_rad: elevation.transpose()?,
                turn_rad_s: turn.get(),
            });
        }
        other => {
            return Err(Failure::input(match did_you_mean(other, VIEWS) {
                Some(guess) => format!("--view {other}: did you mean `{guess}`?"),
                None => format!("--view {other}: it is one of {}", VIEWS.join(", ")),
            }));
        }
    };
    for (option, given) in [
        ("--turn", &options.camera.turn),
        ("--bearing", &options.camera.bearing),
        ("--elevation", &options.camera.elevation),
    ] {
        if given.is_some() {
            return Err(Failure::input(format!(
                "{option}: only --view orbit has it; this is --view {}",
                options.camera.view
            )));
        }
    }
    Ok(View::Side(side))
}

fn fit(word: &str) -> Result<Fit, Failure> {
    match word {
        "swarm" => Ok(Fit::Swarm),
        "world" => Ok(Fit::World),
        other => Err(Failure::input(format!(
            "--fit {other}: it is one of swarm, world"
        ))),
    }
}

/// An angle between two, degrees; in rad.
fn angle_within(option: &str, text: &str, [low, high]: [f64; 2]) -> Result<f64, Failure> {
    let angle: Angle = text
        .parse()
        .map_err(|error| Failure::input(format!("{option}: {error}")))?;
    let within = angle >= Angle::from_degrees(low) && angle <= Angle::from_degrees(high);
    match within {
        true => Ok(angle.get()),
        false => Err(Failure::input(format!(
            "{option} {text}: {low} deg to {high} deg"
        ))),
    }
}

fn cut_open(word: &str) -> Result<CutOpen, Failure> {
    match word {
        "auto" => Ok(CutOpen::Auto),
        "always" => Ok(CutOpen::Always),
        "never" => Ok(CutOpen::Never),
        other => Err(Failure::input(format!(
            "--cut-open {other}: it is one of auto, always, never"
        ))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_is_above_zero_and_said_in_few_digits() {
        let said = |value| positive("--zoom", value, 1e4).expect_err("refused").message;
        assert_eq!(said(1e300), "--zoom 1e300: above 0, at most 10000");
        assert_eq!(said(-0.5), "--zoom -0.5: above 0, at most 10000");
        assert!(said(f64::NAN).contains("NaN"));
        assert_eq!(positive("--zoom", 1e4, 1e4).ok(), Some(1e4));
    }
}
