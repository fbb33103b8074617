//! What numbers are called: names, patterns, and what is said of a name that nothing has.

use super::super::Failure;
use super::source::Source;
use simbeeotic_record::Stage;
use simbeeotic_units::did_you_mean;
use std::collections::BTreeSet;

/// Numbers of vehicles, from their positions and velocities.
pub(super) const STATES: [&str; 6] = ["speed", "climb", "altitude", "x", "y", "z"];
/// Numbers of packets.
pub(super) const PACKETS: [&str; 5] = ["sent", "received", "overheard", "lost", "delivery"];
/// A list in an error is not longer.
const LISTED: usize = 14;

/// Whether a pattern means a name: the whole of it, or, if it has no star, the last part of it.
pub(super) fn means(pattern: &str, name: &str) -> bool {
    if pattern.contains(['*', '?']) {
        return matches(pattern.as_bytes(), name.as_bytes());
    }
    match name.strip_suffix(pattern) {
        Some(above) => above.is_empty() || above.ends_with('/'),
        None => false,
    }
}

/// Whether a pattern with `*` and `?` matches a whole text.
fn matches(pattern: &[u8], text: &[u8]) -> bool {
    let (mut p, mut t) = (0, 0);
    let mut star = None;
    while t < text.len() {
        match pattern.get(p) {
            Some(b'*') => {
                star = Some((p + 1, t));
                p += 1;
            }
            Some(c) if *c == b'?' || *c == text[t] => (p, t) = (p + 1, t + 1),
            _ => {
                let Some((behind, end)) = star else {
                    return false;
                };
                star = Some((behind, end + 1));
                (p, t) = (behind, end + 1);
            }
        }
    }
    pattern[p..].iter().all(|c| *c == b'*')
}

/// Says what there is.
pub(super) fn unknown(source: &Source, name: &str) -> Result<Failure, Failure> {
    let mut names: BTreeSet<String> = BTreeSet::new();
    for metrics in source.recording.metrics() {
        let metrics = metrics.map_err(Failure::run)?;
        names.extend(metrics.values.iter().map(|metric| starred(&metric.name)));
    }
    let published: Vec<String> = names.iter().cloned().collect();
    names.clear();
    for reading in source.recording.readings_in(0..=u64::MAX) {
        let reading = reading.map_err(Failure::run)?;
        let sensor = starred(&reading.sensor);
        match reading.names.as_slice() {
            [] | [_] => drop(names.insert(sensor)),
            several => names.extend(several.iter().map(|column| format!("{sensor}:{column}"))),
        }
    }
    let read: Vec<String> = names.into_iter().collect();
    let fixed = [
        "packets/sent",
        "packets/received",
        "packets/lost",
        "packets/delivery",
    ];
    let known = (STATES.iter().chain(&fixed).copied())
        .chain(published.iter().map(String::as_str))
        .chain(read.iter().map(String::as_str));
    let last = |name: &str| name.rsplit('/').next().unwrap_or_default().to_owned();
    let parts: Vec<String> = published.iter().map(|name| last(name)).collect();
    let guess = did_you_mean(name, known.chain(parts.iter().map(String::as_str)))
        .map_or(".".to_owned(), |guess| format!("; did you mean {guess:?}?"));
    let list = |what: &str, names: &[String]| match names.len() {
        0 => String::new(),
        n => format!(
            "\n  {what}: {}{}",
            names[..n.min(LISTED)].join(", "),
            if n > LISTED { " ..." } else { "" }
        ),
    };
    let radios = match source.recording.traffic_in(0..=u64::MAX).next() {
        None => Vec::new(),
        Some(_) => PACKETS.map(|p| format!("packets/{p}")).to_vec(),
    };
    Ok(Failure::input(format!(
        "{} has no number called {name:?}{guess} It has\n  of each model: {}, distance:MODEL{}{}{}",
        source.file(),
        STATES.join(", "),
        list("of radios", &radios),
        list("metrics", &published),
        list("readings", &read)
    )))
}

/// Refuses what is to be hidden but is the label or kind of nothing in any of these worlds.
pub(in super::super) fn hidden(stages: &[&Stage], hide: &[String]) -> Result<(), Failure> {
    let props = stages.iter().flat_map(|stage| &stage.props);
    let known: BTreeSet<&str> = props
        .flat_map(|prop| [prop.label.as_str(), prop.kind.as_str()])
        .filter(|name| !name.is_empty())
        .collect();
    let Some(strange) = hide.iter().find(|h| !known.contains(h.as_str())) else {
        return Ok(());
    };
    let guess = did_you_mean(strange, known.iter().copied())
        .map_or(".".to_owned(), |guess| format!("; did you mean {guess:?}?"));
    let listed: Vec<&str> = known.iter().copied().take(LISTED).collect();
    let has = match (listed.is_empty(), known.len() > LISTED) {
        (true, _) => "no objects".to_owned(),
        (_, more) => format!(
            "objects of these labels and kinds: {}{}",
            listed.join(", "),
            if more { " ..." } else { "" }
        ),
    };
    Err(Failure::input(format!(
        "--hide {strange}: no object has this label or kind{guess} The world has {has}"
    )))
}

/// A path with stars for its numbers: `bee-*/battery/soc`.
fn starred(path: &str) -> String {
    let part = |part: &str| match part.rsplit_once('-') {
        Some((group, number)) if number.bytes().all(|b| b.is_ascii_digit()) => format!("{group}-*"),
        _ => part.to_owned(),
    };
    let parts: Vec<String> = path.split('/').map(part).collect();
    parts.join("/")
}

#[cfg(test)]
mod tests {
    use super::*;
    use simbeeotic_record::stage::Prop;

    #[test]
    fn what_is_hidden_must_be_there() {
        let prop = |label: &str, kind: &str| Prop {
            label: label.to_owned(),
            kind: kind.to_owned(),
            ..Prop::default()
        };
        let stage = Stage {
            props: vec![prop("roof", "structure"), prop("", "flower")],
            ..Stage::default()
        };
        let hide = |word: &str| hidden(&[&stage], &[word.to_owned()]);
        assert!(hide("roof").is_ok() && hide("structure").is_ok() && hide("flower").is_ok());
        for (word, said) in [
            ("rooof", "did you mean \"roof\"?"),
            ("nosuch", "flower, roof, structure"),
            ("", "no object has this label or kind"),
        ] {
            let error = hide(word).expect_err(word).message;
            assert!(error.contains(said), "{said} in {error}");
        }
        let none = hidden(&[&Stage::default()], &["roof".to_owned()]);
        let none = none.expect_err("an empty world").message;
        assert!(none.contains("no objects"), "{none}");
    }

    #[test]
    fn patterns_mean_whole_names_or_their_last_parts() {
        assert!(means("bee-*/battery/soc", "bee-17/battery/soc"));
        assert!(!means("bee-*/battery", "bee-17/battery/soc"));
        assert!(means("soc", "bee-17/battery/soc") && means("battery/soc", "bee-17/battery/soc"));
        assert!(!means("oc", "bee-17/battery/soc"));
        assert!(means("latency", "latency"));
        assert_eq!(starred("bee-17/battery/soc"), "bee-*/battery/soc");
    }
}
