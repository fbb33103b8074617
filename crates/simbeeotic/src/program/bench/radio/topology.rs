//! A topology: where the nodes are, and when in each second they speak. CSV, the columns named by its
//! header in any order; lines that begin with `#` say how it was made.

use simbeeotic_units::Position;
use simbeeotic_units::glam::DVec3;
use std::collections::BTreeMap;
use std::path::Path;

/// One node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Node {
    pub(super) number: u64,
    pub(super) position: Position,
    /// When, in each second, it asks for its broadcast, ns.
    pub(super) phase_ns: u64,
}

/// The columns of a topology.
const COLUMNS: [&str; 5] = ["node", "x_m", "y_m", "z_m", "phase_s"];

/// Farther from the origin than this, in any direction, a node does not stand, m.
const FAR_M: f64 = 100_000.0;

/// Reads a topology; without `phases`, nobody asks for the column `phase_s`, and all speak at the full
/// second.
///
/// # Errors
/// Everything that is wrong, each with file and line.
pub(super) fn read(path: &Path, phases: bool) -> Result<Vec<Node>, String> {
    let name = path.display().to_string();
    match std::fs::read(path) {
        Err(e) => Err(format!("error: cannot read {name}: {e}")),
        Ok(bytes) => match String::from_utf8(bytes) {
            Err(_) => Err(format!("error: {name} is not text in UTF-8")),
            Ok(text) => parse(&name, &text, phases),
        },
    }
}

fn parse(name: &str, text: &str, phases: bool) -> Result<Vec<Node>, String> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut lines = (1..)
        .zip(text.lines().map(str::trim))
        .filter(|(_, line)| !line.is_empty() && !line.starts_with('#'));
    let at = |line: usize, what: String| format!("error: {name}:{line}: {what}");

    let Some((first, header)) = lines.next() else {
        return Err(format!(
            "error: {name}: no rows; a topology has the columns {} and two rows or more",
            COLUMNS.join(",")
        ));
    };
    let columns = Columns::of(header, phases)
        .map_err(|faults| join(faults.into_iter().map(|fault| at(first, fault)).collect()))?;

    let (mut nodes, mut faults) = (Vec::new(), Vec::new());
    let mut seen = BTreeMap::new();
    for (line, row) in lines {
        match columns.node(row) {
            Err(wrong) => faults.extend(wrong.into_iter().map(|fault| at(line, fault))),
            Ok(node) => {
                if let Some(before) = seen.insert(node.number, line) {
                    let number = node.number;
                    faults.push(at(
                        line,
                        format!("node {number} is there already, in line {before}"),
                    ));
                }
                nodes.push(node);
            }
        }
    }
    if !faults.is_empty() {
        return Err(join(faults));
    }
    match nodes.len() {
        0 => Err(at(first, "no rows follow the header".to_owned())),
        1 => Err(at(
            first,
            "one node has nobody to talk to: a topology has two rows or more".to_owned(),
        )),
        _ => Ok(nodes),
    }
}

/// More faults than this are one and the same.
const FAULTS_MAX: usize = 20;

fn join(mut faults: Vec<String>) -> String {
    let more = faults.len().saturating_sub(FAULTS_MAX);
    faults.truncate(FAULTS_MAX);
    if more > 0 {
        faults.push(format!("error: and {more} more"));
    }
    faults.join("\n")
}

/// Where each column stands in a row.
struct Columns {
    places: [Option<usize>; COLUMNS.len()],
    cells: usize,
}

impl Columns {
    fn of(header: &str, phases: bool) -> Result<Self, Vec<String>> {
        let (mut places, mut faults) = ([None; COLUMNS.len()], Vec::new());
        let cells: Vec<&str> = header.split(',').map(str::trim).collect();
        for (place, cell) in cells.iter().enumerate() {
            match COLUMNS.iter().position(|column| column == cell) {
                None => faults.push(format!(
                    "no column is called '{cell}': the header is {}",
                    COLUMNS.join(",")
                )),
                Some(column) if places[column].is_some() => {
                    faults.push(format!("two columns are called {cell}"));
                }
                Some(column) => places[column] = Some(place),
            }
        }
        let needed = if phases { COLUMNS.len() } else { 4 };
        for column in 0..needed {
            if places[column].is_none() {
                faults.push(format!(
                    "the column {} is missing: the header is {}",
                    COLUMNS[column],
                    COLUMNS.join(",")
                ));
            }
        }
        if !phases {
            places[4] = None;
        }
        match faults.is_empty() {
            true => Ok(Self {
                places,
                cells: cells.len(),
            }),
            false => Err(faults),
        }
    }

    fn node(&self, row: &str) -> Result<Node, Vec<String>> {
        let cells: Vec<&str> = row.split(',').map(str::trim).collect();
        if cells.len() != self.cells {
            return Err(vec![format!(
                "{} cells where the header has {}",
                cells.len(),
                self.cells
            )]);
        }
        let mut faults = Vec::new();
        let mut cell = |column: usize, allowed: &str, ok: fn(f64) -> bool| -> f64 {
            let Some(place) = self.places[column] else {
                return 0.0;
            };
            match cells[place].parse::<f64>() {
                Ok(number) if ok(number) => return number,
                Ok(_) => faults.push(format!(
                    "{} of {}: {allowed}",
                    COLUMNS[column], cells[place]
                )),
                Err(_) => faults.push(format!(
                    "{} of '{}' is not a number",
                    COLUMNS[column], cells[place]
                )),
            }
            0.0
        };
        let number = cell(0, "a whole number from 0 on", |x| {
            x.fract() == 0.0 && (0.0..9e15).contains(&x)
        });
        let [x, y, z] = [1, 2, 3].map(|column| {
            cell(column, "from -100000 to 100000", |x| {
                x.is_finite() && x.abs() <= FAR_M
            })
        });
        let phase = cell(4, "from 0 to below 1", |x| (0.0..1.0).contains(&x));
        if !faults.is_empty() {
            return Err(faults);
        }
        Ok(Node {
            number: number as u64,
            position: Position::from_si(DVec3::new(x, y, z)),
            phase_ns: ((phase * 1e9).round() as u64).min(999_999_999),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn faults(text: &str) -> Vec<String> {
        let all = parse("t.csv", text, true).expect_err("it is wrong");
        all.lines().map(str::to_owned).collect()
    }

    #[test]
    fn columns_stand_in_any_order_with_comments_spaces_and_dos_lines() {
        let plain = "node,x_m,y_m,z_m,phase_s\n0,1,2,3,0.25\n7,-1.5,0,1e1,0.999999999\n";
        let odd = "\u{feff}# made so\r\n phase_s , z_m,node,y_m,x_m\r\n\r\n0.25,3,0,2,1\r\n\
                   # half\r\n 0.999999999 ,10.0, 7 ,0,-1.5\r\n";
        let nodes = parse("t.csv", plain, true).expect("it is right");
        assert_eq!(parse("t.csv", odd, true), Ok(nodes.clone()));
        assert_eq!(nodes[1].number, 7);
        assert_eq!(nodes[1].position.si(), DVec3::new(-1.5, 0.0, 10.0));
        assert_eq!(
            [nodes[0].phase_ns, nodes[1].phase_ns],
            [250_000_000, 999_999_999]
        );
    }

    #[test]
    fn every_bad_line_is_told_at_once() {
        let text = "# how\nnode,x_m,y_m,z_m,phase_s\n0,0,0,0,0\n0,1,1,1,0.5\n1,east,1,1,1.0\n2,1,1\n\
                    3.5,nan,1,1,-0.1\n";
        assert_eq!(
            faults(text),
            [
                "error: t.csv:4: node 0 is there already, in line 3",
                "error: t.csv:5: x_m of 'east' is not a number",
                "error: t.csv:5: phase_s of 1.0: from 0 to below 1",
                "error: t.csv:6: 3 cells where the header has 5",
                "error: t.csv:7: node of 3.5: a whole number from 0 on",
                "error: t.csv:7: x_m of nan: from -100000 to 100000",
                "error: t.csv:7: phase_s of -0.1: from 0 to below 1",
            ]
        );
        let many = format!("{}{}", "node,x_m,y_m,z_m,phase_s\n", "0\n".repeat(50));
        assert_eq!(faults(&many).len(), FAULTS_MAX + 1);
    }

    #[test]
    fn a_header_says_what_it_lacks_and_what_it_has_too_much() {
        let told = faults("node,x_m,y_m,height,y_m\n0,0,0,0,0\n");
        assert_eq!(told.len(), 4, "{told:?}");
        assert!(told[0].contains("'height'"), "{told:?}");
        assert!(told[1].contains("two columns are called y_m"), "{told:?}");
        assert!(told[2].contains("z_m is missing"), "{told:?}");
        assert!(told[3].contains("phase_s is missing"), "{told:?}");
    }

    #[test]
    fn a_topology_has_two_nodes() {
        assert!(faults("# nothing\n\n")[0].contains("t.csv: no rows"));
        assert!(faults("node,x_m,y_m,z_m,phase_s\n")[0].contains("t.csv:1: no rows"));
        assert!(faults("node,x_m,y_m,z_m,phase_s\n0,0,0,0,0\n")[0].contains("nobody to talk to"));
    }

    #[test]
    fn without_phases_nobody_asks_for_them() {
        let with = "node,x_m,y_m,z_m,phase_s\n0,0,0,0,0.5\n1,0,0,1,never\n";
        let without = "node,x_m,y_m,z_m\n0,0,0,0\n1,0,0,1\n";
        let nodes = parse("t.csv", with, false).expect("phases are not read");
        assert_eq!(parse("t.csv", without, false), Ok(nodes.clone()));
        assert!(nodes.iter().all(|node| node.phase_ns == 0));
    }
}
