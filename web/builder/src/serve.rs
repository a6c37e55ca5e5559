//! Serves the page on the loopback address.

use std::fs;
use std::path::{Component, Path, PathBuf};

use tiny_http::{Header, Response, Server};

/// Serves a folder until interrupted.
pub(crate) fn serve(folder: &Path, port: u16) -> Result<(), String> {
    let server = Server::http(("127.0.0.1", port)).map_err(|error| format!("port {port}: {error}"))?;
    let address = server.server_addr();
    println!("http://{address}/ until Ctrl-C");
    for request in server.incoming_requests() {
        let file = named(folder, request.url());
        // The client may have disconnected.
        let _ = match fs::read(&file) {
            Ok(data) => request.respond(Response::from_data(data).with_header(content_type(&file))),
            Err(_) => request.respond(Response::from_string("not found").with_status_code(404)),
        };
    }
    Ok(())
}

/// Returns the file of a URL, never outside the folder.
fn named(folder: &Path, url: &str) -> PathBuf {
    let path = url.split(['?', '#']).next().unwrap_or_default();
    let inside = Path::new(path).components().filter(|part| matches!(part, Component::Normal(_)));
    let file = inside.fold(folder.to_owned(), |file, part| file.join(part));
    if file.is_dir() { file.join("index.html") } else { file }
}

fn content_type(file: &Path) -> Header {
    let kind = match file.extension().and_then(|extension| extension.to_str()) {
        Some("html") => "text/html; charset=utf-8",
        Some("mjs" | "js") => "text/javascript; charset=utf-8",
        Some("css") => "text/css; charset=utf-8",
        Some("json") => "application/json",
        Some("wasm") => "application/wasm",
        Some("png") => "image/png",
        Some("webp") => "image/webp",
        _ => "application/octet-stream",
    };
    let Ok(header) = Header::from_bytes("Content-Type", kind) else { unreachable!("the words are ASCII") };
    header
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn urls_stay_inside_the_folder() {
        let folder = Path::new("page");
        assert_eq!(named(folder, "/main.mjs?x=1"), Path::new("page/main.mjs"));
        assert_eq!(named(folder, "/../../etc/passwd"), Path::new("page/etc/passwd"));
        assert_eq!(named(folder, "//etc/passwd"), Path::new("page/etc/passwd"));
    }
}
