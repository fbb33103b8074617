//! A topology: where the nodes are, and when in each second they speak. CSV, the columns named by its
//! header in any order, others among them; lines that begin with `#` say how it was made.

use simbeeotic_units::Position;
use simbeeotic_units::glam::DVec3;
use std::collections::BTreeMap;
use std::path::Path;

/// One node.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Node {
    /// Any text; no other node has it.
    pub(super) name: String,
    pub(super) position: Position,
    /// When, in each second, it asks for its broadcast, ns.
    pub(super) phase_ns: u64,
}

/// The columns of a topology.
const COLUMNS: [&str; 5] = ["node", "x_m", "y_m", "z_m", "phase_s"];

/// Farther from the origin than this, in any direction, a node does not stand, m.
const FAR_M: f64 = 100_000.0;

/// Reads a topology, its nodes in the order of the file; without `phases`, nobody asks for the column `phase_s`, and all speak at the full
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
                if let Some(before) = seen.insert(node.name.clone(), line) {
                    let fault = format!("node {} is there already, in line {before}", node.name);
                    faults.push(at(line, fault));
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

/// The cells of a row, without the blanks around them. A cell may stand in quotes, and then have commas in
/// it, and quotes as two.
fn cells(row: &str) -> Vec<String> {
    let (mut cells, mut cell, mut quoted) = (Vec::new(), String::new(), false);
    let mut letters = row.chars().peekable();
    while let Some(letter) = letters.next() {
        match letter {
            '"' if quoted && letters.next_if_eq(&'"').is_some() => cell.push('"'),
            '"' if quoted => quoted = false,
            '"' if cell.trim().is_empty() => quoted = true,
            ',' if !quoted => cells.push(std::mem::take(&mut cell)),
            letter => cell.push(letter),
        }
    }
    cells.push(cell);
    cells
        .into_iter()
        .map(|cell| cell.trim().to_owned())
        .collect()
}

/// Takes blank cells off the end of a row, as trailing commas make them, down to so many cells.
fn trim(cells: &mut Vec<String>, least: usize) {
    while cells.len() > least && cells.last().is_some_and(String::is_empty) {
        cells.pop();
    }
}

/// Where each column stands in a row.
struct Columns {
    places: [Option<usize>; COLUMNS.len()],
    cells: usize,
}

impl Columns {
    fn of(header: &str, phases: bool) -> Result<Self, Vec<String>> {
        let (mut places, mut faults) = ([None; COLUMNS.len()], Vec::new());
        let mut cells = cells(header);
        trim(&mut cells, 0);
        for (place, cell) in cells.iter().enumerate() {
            // Columns of other names are for others.
            let Some(column) = COLUMNS.iter().position(|column| column == cell) else {
                continue;
            };
            match places[column] {
                Some(_) => faults.push(format!("two columns are called {cell}")),
                None => places[column] = Some(place),
            }
        }
        if places == [None; COLUMNS.len()] {
            return Err(vec![format!(
                "this is no header: a topology begins with the names of its columns, {}",
                COLUMNS.join(",")
            )]);
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
        let mut cells = cells(row);
        trim(&mut cells, self.cells);
        if cells.len() != self.cells {
            return Err(vec![format!(
                "{} cells where the header has {}",
                cells.len(),
                self.cells
            )]);
        }
        let mut faults = Vec::new();
        let text = |column: usize| self.places[column].map(|place| cells[place].as_str());
        let mut number = |column: usize, allowed: &str, ok: fn(f64) -> bool| -> f64 {
            let Some(cell) = text(column) else {
                return 0.0;
            };
            match cell.parse::<f64>() {
                Ok(number) if ok(number) => return number,
                Ok(_) => faults.push(format!("{} of {cell}: {allowed}", COLUMNS[column])),
                Err(_) => faults.push(format!("{} of '{cell}' is not a number", COLUMNS[column])),
            }
            0.0
        };
        let [x, y, z] = [1, 2, 3].map(|column| {
            number(column, "from -100000 to 100000", |x| {
                x.is_finite() && x.abs() <= FAR_M
            })
        });
        let phase = number(4, "from 0 to 1", |x| (0.0..=1.0).contains(&x));
        let name = text(0).unwrap_or_default().to_owned();
        if name.is_empty() {
            faults.push("a node without a name".to_owned());
        }
        if !faults.is_empty() {
            return Err(faults);
        }
        Ok(Node {
            name,
            position: Position::from_si(DVec3::new(x, y, z)),
            // 1 is the 0 of the next second.
            phase_ns: (phase * 1e9).round() as u64 % 1_000_000_000,
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
        assert_eq!([&nodes[0].name, &nodes[1].name], ["0", "7"]);
        assert_eq!(nodes[1].position.si(), DVec3::new(-1.5, 0.0, 10.0));
        assert_eq!(
            [nodes[0].phase_ns, nodes[1].phase_ns],
            [250_000_000, 999_999_999]
        );
    }

    #[test]
    fn files_of_others_are_read_with_quotes_names_and_columns_of_theirs() {
        let text = "\"\",\"node\",\"x_m\",\"y_m\",\"z_m\",\"phase_s\",note,\n\
                    \"1\",\"bee, the \"\"old\"\"\",1,2,3,1.000,why not,\n2,b/left,4,5,6,0.5,,,,\n3, a ,7,8,9,0,\"x,y\"\n";
        let nodes = parse("t.csv", text, true).expect("it is right");
        let names: Vec<&str> = nodes.iter().map(|node| node.name.as_str()).collect();
        assert_eq!(
            names,
            ["bee, the \"old\"", "b/left", "a"],
            "in the file's order"
        );
        assert_eq!(nodes[2].position.si(), DVec3::new(7.0, 8.0, 9.0));
        assert_eq!(nodes[0].phase_ns, 0, "of the next second");
        assert_eq!(nodes[1].phase_ns, 500_000_000);
    }

    #[test]
    fn every_bad_line_is_told_at_once() {
        let text = "# how\nnode,x_m,y_m,z_m,phase_s\n0,0,0,0,0\n0,1,1,1,0.5\n1,east,1,1,1.01\n2,1,1\n\
                    ,nan,1,1,-0.1\n";
        assert_eq!(
            faults(text),
            [
                "error: t.csv:4: node 0 is there already, in line 3",
                "error: t.csv:5: x_m of 'east' is not a number",
                "error: t.csv:5: phase_s of 1.01: from 0 to 1",
                "error: t.csv:6: 3 cells where the header has 5",
                "error: t.csv:7: x_m of nan: from -100000 to 100000",
                "error: t.csv:7: phase_s of -0.1: from 0 to 1",
                "error: t.csv:7: a node without a name",
            ]
        );
        let many = format!("{}{}", "node,x_m,y_m,z_m,phase_s\n", "0\n".repeat(50));
        assert_eq!(faults(&many).len(), FAULTS_MAX + 1);
    }

    #[test]
    fn a_header_says_what_it_lacks_and_what_it_has_twice() {
        let told = faults("node,x_m,y_m,height,y_m\n0,0,0,0,0\n");
        assert_eq!(told.len(), 3, "{told:?}");
        assert!(told[0].contains("two columns are called y_m"), "{told:?}");
        assert!(told[1].contains("z_m is missing"), "{told:?}");
        assert!(told[2].contains("phase_s is missing"), "{told:?}");
        let told = faults("0,0,0,0,0\n1,1,1,1,0.5\n");
        assert_eq!(told.len(), 1, "{told:?}");
        assert!(
            told[0].starts_with("error: t.csv:1: this is no header"),
            "{told:?}"
        );
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
