//! CSV and Parquet hold what was recorded.

use crate::swarm::{self, TICK_NS};
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::{Row, RowAccessor};
use simbeeotic_record::{
    Column, ExportError, Exported, Header, Precision, Recording, Selection, Values, export_csv,
    export_csv_file, export_parquet, write_table,
};
use std::fs::File;
use std::num::NonZeroU64;
use std::path::Path;

fn recording(folder: &Path, header: Header, ticks: u64) -> Recording {
    let path = folder.join("run.mcap");
    swarm::record(&path, header, ticks);
    Recording::open(path).expect("opens")
}

fn csv(recording: &Recording, selection: &Selection) -> (String, Exported) {
    let mut out = Vec::new();
    let exported = export_csv(recording, selection, &mut out).expect("exported");
    (String::from_utf8(out).expect("text"), exported)
}

fn rows(path: &Path) -> Vec<Row> {
    let file = File::open(path).expect("there");
    let reader = SerializedFileReader::new(file).expect("Parquet");
    let rows = reader.get_row_iter(None).expect("rows");
    rows.collect::<Result<_, _>>().expect("readable")
}

#[test]
fn csv_holds_what_was_recorded() {
    let folder = tempfile::tempdir().expect("a folder");
    let recording = recording(folder.path(), swarm::header(5), 12);
    let (text, exported) = csv(&recording, &Selection::default());
    assert_eq!(
        exported,
        Exported {
            rows: 60,
            ticks: 12,
            models: 5
        }
    );

    let mut lines = text.lines();
    assert_eq!(
        lines.next(),
        Some(
            "time_s,time_ns,model,x_m,y_m,z_m,vx_m_s,vy_m_s,vz_m_s,\
             qw,qx,qy,qz,wx_rad_s,wy_rad_s,wz_rad_s"
        )
    );
    for tick in 0..12 {
        for vehicle in 0..5 {
            let fields: Vec<&str> = lines.next().expect("a row").split(',').collect();
            assert_eq!(fields[1], (tick * TICK_NS).to_string());
            assert_eq!(fields[2], format!("bee-{vehicle}"));
            let number = |place: usize| fields[place].parse::<f64>().expect("a number");
            assert_eq!(number(0), tick as f64 / 10.0);
            let sample = swarm::sample(tick, vehicle);
            assert_eq!([3, 4, 5].map(number), sample.position_m);
            assert_eq!([6, 7, 8].map(number), sample.velocity_m_s);
            assert_eq!([9, 10, 11, 12].map(number), sample.world_from_body);
            assert_eq!([13, 14, 15].map(number), sample.rate_rad_s);
        }
    }
    assert_eq!(lines.next(), None);
}

#[test]
fn fine_recordings_have_no_false_digits() {
    let folder = tempfile::tempdir().expect("a folder");
    let header = Header {
        precision: Precision::Fine,
        ..swarm::header(5)
    };
    let recording = recording(folder.path(), header, 12);
    let path = folder.path().join("run.csv");
    std::fs::write(&path, "old").expect("written");
    export_csv_file(&recording, &Selection::default(), &path).expect("exported");
    let text = std::fs::read_to_string(&path).expect("there");
    assert_eq!(text.lines().count(), 61);
    for line in text.lines().skip(1) {
        for (place, field) in line.split(',').enumerate().skip(3) {
            let decimals = field.split_once('.').map_or(0, |(_, digits)| digits.len());
            let most = if (9..13).contains(&place) { 7 } else { 6 };
            assert!(decimals <= most, "{field} in {line}");
        }
    }
}

#[test]
fn parquet_holds_what_was_recorded() {
    let folder = tempfile::tempdir().expect("a folder");
    let recording = recording(folder.path(), swarm::header(5), 12);
    let path = folder.path().join("run.parquet");
    let exported = export_parquet(&recording, &Selection::default(), &path).expect("exported");
    assert_eq!(
        exported,
        Exported {
            rows: 60,
            ticks: 12,
            models: 5
        }
    );

    let rows = rows(&path);
    assert_eq!(rows.len(), 60);
    for (place, row) in rows.iter().enumerate() {
        let (tick, vehicle) = (place as u64 / 5, place % 5);
        let sample = swarm::sample(tick, vehicle);
        let double = |column: usize| row.get_double(column).expect("a double");
        let float = |column: usize| f64::from(row.get_float(column).expect("a float"));
        assert_eq!(double(0), tick as f64 / 10.0);
        assert_eq!(
            row.get_long(1).expect("a long"),
            (tick * TICK_NS).cast_signed()
        );
        assert_eq!(
            row.get_string(2).expect("a text"),
            &format!("bee-{vehicle}")
        );
        assert_eq!([3, 4, 5].map(double), sample.position_m);
        assert_eq!([6, 7, 8].map(float), sample.velocity_m_s);
        assert_eq!([9, 10, 11, 12].map(double), sample.world_from_body);
        assert_eq!([13, 14, 15].map(float), sample.rate_rad_s);
    }
    let names: Vec<_> = rows[0]
        .get_column_iter()
        .map(|(name, _)| name.clone())
        .collect();
    let (text, _) = csv(&recording, &Selection::default());
    assert_eq!(
        Some(names.join(",").as_str()),
        text.lines().next(),
        "the same columns as CSV"
    );
}

#[test]
fn parquet_of_many_row_groups_is_whole() {
    let folder = tempfile::tempdir().expect("a folder");
    let recording = recording(folder.path(), swarm::header(3000), 100);
    let path = folder.path().join("run.parquet");
    export_parquet(&recording, &Selection::default(), &path).expect("exported");

    let file = File::open(&path).expect("there");
    let reader = SerializedFileReader::new(file).expect("Parquet");
    assert_eq!(reader.metadata().num_row_groups(), 2);
    assert_eq!(reader.metadata().file_metadata().num_rows(), 300_000);
    let last = reader
        .get_row_iter(None)
        .expect("rows")
        .last()
        .expect("one");
    let last = last.expect("readable");
    assert_eq!(last.get_string(2).expect("a text"), "bee-2999");
    assert_eq!(
        last.get_double(3).expect("a double"),
        swarm::sample(99, 2999).position_m[0]
    );
}

#[test]
fn a_selection_takes_some_models_some_ticks_and_some_time() {
    let folder = tempfile::tempdir().expect("a folder");
    let recording = recording(folder.path(), swarm::header(12), 50);
    let selection = Selection {
        every: NonZeroU64::new(10).expect("positive"),
        models: vec!["bee-1*".into()],
        times_ns: 5 * TICK_NS..=25 * TICK_NS,
    };
    let (text, exported) = csv(&recording, &selection);
    assert_eq!(
        exported,
        Exported {
            rows: 9,
            ticks: 3,
            models: 3
        }
    );
    let found: Vec<_> = text
        .lines()
        .skip(1)
        .map(|line| line.split(',').collect::<Vec<_>>()[..3].join(" "))
        .collect();
    assert_eq!(found[0], "0.5 500000000 bee-1");
    assert_eq!(found[2], "0.5 500000000 bee-11");
    assert_eq!(found[8], "2.5 2500000000 bee-11");

    let nobody = Selection {
        models: vec!["bea-*".into()],
        ..Selection::default()
    };
    let error = export_csv(&recording, &nobody, &mut std::io::sink()).expect_err("no bea");
    assert_eq!(
        error.to_string(),
        "no recorded model matches \"bea-*\"; the recording has 12, from \"bee-0\" to \"bee-11\""
    );
}

#[test]
fn a_recording_without_twists_has_no_columns_for_them() {
    let folder = tempfile::tempdir().expect("a folder");
    let header = Header {
        twists: false,
        ..swarm::header(1)
    };
    let recording = recording(folder.path(), header, 3);
    let (text, _) = csv(&recording, &Selection::default());
    assert_eq!(
        text.lines().next(),
        Some("time_s,time_ns,model,x_m,y_m,z_m,qw,qx,qy,qz")
    );

    let path = folder.path().join("run.parquet");
    export_parquet(&recording, &Selection::default(), &path).expect("exported");
    assert_eq!(rows(&path)[0].len(), 10);
}

#[test]
fn a_damaged_recording_publishes_no_parquet() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    swarm::record(&path, swarm::header(1000), 100);
    let mut bytes = std::fs::read(&path).expect("there");
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    std::fs::write(&path, bytes).expect("written");

    let recording = Recording::open(&path).expect("opens");
    let table = folder.path().join("run.parquet");
    let result = export_parquet(&recording, &Selection::default(), &table);
    assert!(matches!(result, Err(ExportError::Read(_))));
    assert_eq!(
        std::fs::read_dir(folder.path()).expect("a folder").count(),
        1,
        "no rubbish"
    );
}

#[test]
fn a_table_holds_its_columns() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("table.parquet");
    let columns = [
        Column::integers("n", vec![1000, 3000]),
        Column::floats("speed", vec![12.5, f64::NAN]),
        Column::texts("host", vec!["a".into(), "wüste".into()]),
        Column {
            name: "quick".into(),
            values: Values::Bool(vec![true, false]),
        },
    ];
    write_table(&path, &columns).expect("written");

    let rows = rows(&path);
    assert_eq!(rows.len(), 2);
    assert_eq!(rows[0].get_long(0).expect("a long"), 1000);
    assert_eq!(rows[0].get_double(1).expect("a double"), 12.5);
    assert!(rows[1].get_double(1).expect("a double").is_nan());
    assert_eq!(rows[1].get_string(2).expect("a text"), "wüste");
    assert!(rows[0].get_bool(3).expect("a bool"));
}

#[test]
fn columns_that_make_no_table_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("table.parquet");
    let refused = |columns: &[Column]| {
        let error = write_table(&path, columns)
            .expect_err("refused")
            .to_string();
        error.split_once(": ").expect("path: reason").1.to_string()
    };
    let n = || Column::integers("n", vec![1, 2]);
    assert_eq!(refused(&[]), "a table needs a column");
    assert_eq!(refused(&[n(), n()]), "two columns are named \"n\"");
    assert_eq!(
        refused(&[n(), Column::floats("x", vec![1.0])]),
        "column \"x\" has 1 rows, \"n\" has 2"
    );
    assert!(!path.exists());
}

#[test]
fn an_empty_table_is_a_table() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("table.parquet");
    write_table(&path, &[Column::floats("x", vec![])]).expect("written");
    assert!(rows(&path).is_empty());
}
