//! The page: `run --view`, and `view` for recordings.

use super::arguments::{PageOptions, RunOptions, ViewOptions};
use super::run::at_interrupt;
use super::{Failure, remark};
use simbeeotic_model::config::{Node, Span, read_params};
use simbeeotic_model::{FromParams, Setup};
use simbeeotic_scenario::Loaded;
use simbeeotic_view::live::{Viewer, ViewerParams, open_browser};
use simbeeotic_view::replay::Replay;
use simbeeotic_view::server::{Options, Server, ServerError, Visitors};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// The viewer's name on the shelf.
pub(super) const VIEWER: &str = "viewer";

/// Adds the viewer that `--view` asks for, or takes the scenario's, and shows its address. Who looks at
/// it, if there is one.
pub(super) fn choose_viewer(
    setup: &mut Setup,
    loaded: &Loaded,
    options: &RunOptions,
) -> Result<Option<Visitors>, Failure> {
    let mut choices = loaded.plan().components.iter();
    let choice = choices.find(|choice| choice.part.label.name == VIEWER);
    if choice.is_none() && !options.view {
        let paused = options.paused.then_some("--paused");
        if let Some(option) = first_said(&options.page).or(paused) {
            return Err(Failure::input(format!(
                "{option} is about the page, and there is none: add --view"
            )));
        }
        return Ok(None);
    }
    let node = choice.map_or_else(|| Node::table(Span::default()), |c| c.params.clone());
    let mut params: ViewerParams = read_params(&node).map_err(|faults| {
        let lines: Vec<String> = faults.iter().map(ToString::to_string).collect();
        Failure::input(lines.join("\n"))
    })?;
    let PageOptions {
        open,
        port,
        address,
    } = options.page.clone();
    params.open |= open;
    params.paused |= options.paused;
    params.port = port.or(params.port);
    params.address = address.unwrap_or(params.address);
    let open = params.open;
    let mut viewer =
        Viewer::from_params(params).map_err(|e| Failure::input(format!("the page: {e}")))?;
    let url = viewer.bind().map_err(no_server)?;
    let visitors = viewer.visitors();
    announce(&url, visitors.as_ref(), open);
    setup.components.retain(|(name, _)| name != VIEWER);
    setup.components.push((VIEWER.to_owned(), Box::new(viewer)));
    Ok(visitors)
}

fn first_said(page: &PageOptions) -> Option<&'static str> {
    match page {
        PageOptions { open: true, .. } => Some("--open"),
        PageOptions { port: Some(_), .. } => Some("--port"),
        PageOptions {
            address: Some(_), ..
        } => Some("--address"),
        _ => None,
    }
}

fn no_server(error: ServerError) -> Failure {
    Failure::input(format!("the page: {error}"))
}

/// Shows the address of the page, and the page itself if that is wanted.
fn announce(url: &str, visitors: Option<&Visitors>, open: bool) {
    remark(format!("page: {url}"));
    if let Some(elsewhere) = visitors.and_then(Visitors::elsewhere) {
        remark(format!("from other machines: {elsewhere}"));
    }
    if open && let Err(why) = open_browser(url) {
        remark(format!("note: {why}; open the page by hand"));
    }
}

/// Shows a recording until the last page is closed, or an interrupt.
pub(super) fn view(options: &ViewOptions) -> Result<(), Failure> {
    let replay = Replay::open(&options.recording).map_err(Failure::input)?;
    if replay.ticks() == 0 {
        return Err(Failure::input(format!(
            "{}: there is nothing to see, not one tick was recorded",
            options.recording.display()
        )));
    }
    if replay.truncated() {
        remark(format!(
            "note: {} was cut off; it reads up to {:.3} s",
            options.recording.display(),
            replay.end_s()
        ));
    }
    let page = &options.page;
    let mut place = Options {
        port: page.port,
        ..Options::default()
    };
    if let Some(address) = &page.address {
        place.address = simbeeotic_view::server::address_of(address)
            .map_err(|e| Failure::input(format!("--address {address}: {e}")))?;
    }
    let server = Server::start(place).map_err(no_server)?;
    server.show(Arc::new(replay));
    let interrupted = at_interrupt(|| {});
    announce(&server.url(), Some(&server.visitors()), page.open);
    linger(&server.visitors(), &interrupted, || {});
    Ok(())
}

/// Stays until the last page is closed, or an interrupt; does `meanwhile` ten times a second.
pub(super) fn linger(visitors: &Visitors, interrupted: &AtomicBool, mut meanwhile: impl FnMut()) {
    remark("the page stays until it is closed, or Ctrl-C");
    visitors.wait_for_the_last(|| {
        meanwhile();
        interrupted.load(Ordering::Relaxed)
    });
}
