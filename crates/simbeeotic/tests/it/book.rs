//! The book's scenarios run. Its Rust code is compiled as doctests of the facade.

use crate::program::Program;

#[test]
fn the_scenarios_of_the_first_chapter_run() {
    let chapter = include_str!("../../../../docs/book/src/first-swarm.md");
    let mut scenarios = 0;
    for block in chapter.split("```toml").skip(1) {
        let text = block.split("```").next().expect("a block ends");
        // Blocks without [run] show a part of a file; behaviours of the chapter's own crate are
        // compiled there.
        if !text.contains("[run]") || text.contains("\"homing-bee\"") {
            continue;
        }
        let program = Program::new();
        program.write("book.toml", text);
        let call = program.call(&["run", "book.toml", "--quiet", "--end-time", "2 s"]);
        assert_eq!(call.code, Some(0), "{}\n{text}", call.err);
        scenarios += 1;
    }
    assert!(scenarios >= 2, "the chapter shows scenarios");
}
