//! The page, as it was built, and how files are answered.

use super::head::Head;

const INDEX: &str = include_str!("../../page/dist/index.html");
const SCRIPT: &[u8] = include_bytes!("../../page/dist/page.js");
const STYLE: &[u8] = include_bytes!("../../page/dist/page.css");

/// A file of the page: its media type and bytes.
pub(super) fn file(path: &str, token: Option<&str>) -> Option<(&'static str, Vec<u8>)> {
    match path {
        "/" | "/index.html" => Some(("text/html; charset=utf-8", index(token).into_bytes())),
        "/page.js" => Some(("text/javascript; charset=utf-8", SCRIPT.to_vec())),
        "/page.css" => Some(("text/css; charset=utf-8", STYLE.to_vec())),
        _ => None,
    }
}

/// The page; what it loads is asked for with the token, too.
fn index(token: Option<&str>) -> String {
    let Some(token) = token else {
        return INDEX.to_owned();
    };
    let with = |page: String, name: &str| {
        page.replace(&format!("\"{name}\""), &format!("\"{name}?token={token}\""))
    };
    with(with(INDEX.to_owned(), "page.js"), "page.css")
}

/// The head of an answer. `host`: for whom, already looked at.
pub(super) fn answer(status: u16, media_type: &str, length: usize, host: Option<&str>) -> String {
    let reason = match status {
        200 => "OK",
        400 => "Bad Request",
        401 => "Unauthorized",
        403 => "Forbidden",
        404 => "Not Found",
        405 => "Method Not Allowed",
        426 => "Upgrade Required",
        431 => "Request Header Fields Too Large",
        _ => "Service Unavailable",
    };
    let socket = host.map_or_else(String::new, |host| format!(" ws://{host}"));
    format!(
        "HTTP/1.1 {status} {reason}\r\n\
         Content-Type: {media_type}\r\n\
         Content-Length: {length}\r\n\
         Cache-Control: no-store\r\n\
         Content-Security-Policy: default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; \
         img-src 'self' data: blob:; connect-src 'self'{socket}; base-uri 'none'; form-action 'none'; \
         frame-ancestors 'none'\r\n\
         X-Content-Type-Options: nosniff\r\n\
         X-Frame-Options: DENY\r\n\
         Cross-Origin-Resource-Policy: same-origin\r\n\
         Referrer-Policy: no-referrer\r\n\
         Connection: close\r\n\r\n"
    )
}

/// The name of a texture in a path. It is looked up among names, and never opened.
pub(super) fn texture(head: &Head) -> Option<String> {
    let mut bytes = head.path.strip_prefix("/textures/")?.bytes();
    let mut name = Vec::new();
    while let Some(byte) = bytes.next() {
        name.push(match byte {
            b'%' => {
                let digits = [bytes.next()?, bytes.next()?];
                let digit = |byte: u8| char::from(byte).to_digit(16);
                u8::try_from(digit(digits[0])? * 16 + digit(digits[1])?).ok()?
            }
            byte => byte,
        });
    }
    String::from_utf8(name).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_page_asks_for_its_files_with_the_token() {
        assert_eq!(index(None), INDEX);
        let page = index(Some("0123"));
        for name in ["page.js", "page.css"] {
            assert!(INDEX.contains(&format!("\"{name}\"")), "{name}");
            assert!(page.contains(&format!("\"{name}?token=0123\"")), "{name}");
        }
    }

    #[test]
    fn nothing_outside_the_page_is_a_file_of_it() {
        for path in ["", "/../Cargo.toml", "/page.jsx", "//", "/%2e%2e/x"] {
            assert!(file(path, None).is_none(), "{path}");
        }
        let name = |path: &str| {
            let text = format!("GET {path} HTTP/1.1\r\nHost: a\r\n\r\n");
            Head::parse(text.as_bytes())
                .ok()
                .and_then(|head| texture(&head))
        };
        assert_eq!(
            name("/textures/pictures%2Fa%20b.png"),
            Some("pictures/a b.png".to_owned())
        );
        for path in [
            "/textures/%2",
            "/textures/%zz",
            "/textures/%ff",
            "/texture/a",
        ] {
            assert_eq!(name(path), None, "{path}");
        }
    }
}
