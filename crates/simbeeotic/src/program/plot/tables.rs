//! A table as rows of texts, from CSV, JSON or Parquet, by the ending of the file's name.

use super::super::Failure;
use super::super::table::{csv, read_csv};
use serde_json::Value;
use simbeeotic_record::read_table;
use std::path::Path;

/// The rows, that of the names first, or what is wrong with the file.
pub(super) fn rows(path: &Path) -> Result<Vec<Vec<String>>, Failure> {
    let ending = path.extension().and_then(|ending| ending.to_str());
    let ending = ending.map(str::to_ascii_lowercase);
    if ending.as_deref() == Some("parquet") {
        let columns = read_table(path).map_err(Failure::input)?;
        let mut text = Vec::new();
        let written = csv(&mut text, &columns).ok();
        let text = written.and_then(|()| String::from_utf8(text).ok());
        let rows = text.and_then(|text| read_csv(&text));
        return rows.ok_or_else(|| refused(path, "its names are no text"));
    }
    let bytes = std::fs::read(path)
        .map_err(|e| Failure::input(format!("cannot read {}: {e}", path.display())))?;
    let text = String::from_utf8(bytes).map_err(|_| refused(path, "this is no table of text"))?;
    if ending.as_deref() == Some("json") {
        return json(&text).map_err(|what| refused(path, &what));
    }
    let mut rows = read_csv(&text).ok_or_else(|| refused(path, "a quote in it is never closed"))?;
    // Editors like to end a file with an empty line.
    while rows
        .last()
        .is_some_and(|row| matches!(row.as_slice(), [one] if one.is_empty()))
    {
        rows.pop();
    }
    Ok(rows)
}

/// Says what is wrong with a table, and which are right.
pub(super) fn refused(path: &Path, what: &str) -> Failure {
    Failure::input(format!(
        "{}: {what}; `simbeeotic sweep` writes such a table, as .csv, .json or .parquet",
        path.display()
    ))
}

/// A list of objects of the same names: a row each.
fn json(text: &str) -> Result<Vec<Vec<String>>, String> {
    let list: Value = serde_json::from_str(text).map_err(|e| format!("this is no JSON: {e}"))?;
    let list = list.as_array().ok_or("a list of runs is wanted")?;
    let mut names: Vec<String> = Vec::new();
    let mut rows = Vec::new();
    for (at, object) in list.iter().enumerate() {
        let number = at + 1;
        let object = (object.as_object()).ok_or_else(|| format!("entry {number} is no object"))?;
        if at == 0 {
            names = object.keys().cloned().collect();
        }
        let field = |name: &String| match object.get(name) {
            None => Err(format!("entry {number} has no {name:?}")),
            Some(Value::Null) => Ok(String::new()),
            Some(Value::String(text)) => Ok(text.clone()),
            Some(Value::Array(_) | Value::Object(_)) => Err(format!(
                "entry {number}: {name:?} is neither a number nor a text"
            )),
            Some(value) => Ok(value.to_string()),
        };
        rows.push(names.iter().map(field).collect::<Result<Vec<_>, _>>()?);
    }
    rows.insert(0, names);
    Ok(rows)
}

#[cfg(test)]
mod tests {
    use super::*;
    use simbeeotic_record::{Column, write_table};

    const CSV: &str = "run,world,spread [m]\n1,\"a,b\",1.5\n2,,\n";

    #[test]
    fn the_three_kinds_of_files_have_the_same_rows() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = |name: &str| folder.path().join(name);
        std::fs::write(path("a.csv"), format!("{CSV}\n")).expect("written");
        let text = r#"[{"run": 1, "world": "a,b", "spread [m]": 1.5},
                       {"spread [m]": null, "world": "", "run": 2}]"#;
        std::fs::write(path("a.json"), text).expect("written");
        let columns = [
            Column::integers("run", vec![1, 2]),
            Column::texts("world", vec!["a,b".into(), String::new()]),
            Column::floats("spread [m]", vec![1.5, f64::NAN]),
        ];
        write_table(path("a.parquet"), &columns).expect("written");
        let wanted = read_csv(CSV).expect("rows");
        for name in ["a.csv", "a.json", "a.parquet"] {
            let found = rows(&path(name)).unwrap_or_else(|e| panic!("{}", e.message));
            assert_eq!(found, wanted, "{name}");
        }
    }

    #[test]
    fn what_is_no_table_says_why() {
        let folder = tempfile::tempdir().expect("a folder");
        for (name, text, told) in [
            ("a.json", "{}", "a list of runs"),
            ("a.json", "[1]", "entry 1 is no object"),
            ("a.json", "[{\"a\": 1}, {\"b\": 2}]", "entry 2 has no \"a\""),
            ("a.json", "[{\"a\": []}]", "neither a number nor a text"),
            ("a.json", "[", "no JSON"),
            ("a.csv", "a\n\"b\n", "never closed"),
            ("a.parquet", "a,b\n", "no Parquet file"),
        ] {
            let path = folder.path().join(name);
            std::fs::write(&path, text).expect("written");
            let said = rows(&path).expect_err(text).message;
            assert!(said.contains(told), "{said}");
        }
    }
}
