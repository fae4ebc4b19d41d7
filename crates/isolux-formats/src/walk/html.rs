//! One file with all in it, which opens from a disk.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

/// The page without data.
#[derive(Clone, Copy, Debug)]
pub struct Page<'a>(pub &'a str);

/// The data of one map.
#[derive(Clone, Debug, Default)]
pub struct Embedded {
    /// Container of the scene.
    pub scene: Vec<u8>,
    /// Container of the mesh.
    pub mesh: Vec<u8>,
    /// Container of the light.
    pub light: Vec<u8>,
    /// Calculation grids, JSON.
    pub grids: Vec<u8>,
}

/// The marker in the page that data take the place of.
const MARKER: &str = "<!--isolux-data-->";

/// The page with data in it; `None` where the page has no place for them. `hello` is JSON.
pub fn embed(page: Page<'_>, hello: &str, worlds: &[Embedded]) -> Option<String> {
    let (before, after) = page.0.split_once(MARKER)?;
    let mut all = String::from(before);
    // A script ends at "</": JSON says the same with an escaped slash.
    let hello = hello.replace("</", "<\\/");
    all.push_str(&format!(
        "<script id=\"isolux-hello\" type=\"application/json\">{hello}</script>"
    ));
    for (number, world) in worlds.iter().enumerate() {
        let parts = [
            ("scene", &world.scene),
            ("mesh", &world.mesh),
            ("light", &world.light),
            ("grids", &world.grids),
        ];
        for (name, bytes) in parts {
            all.push_str(&script(&format!("isolux-{name}-{number}"), bytes));
        }
    }
    all.push_str(after);
    Some(all)
}

fn script(id: &str, bytes: &[u8]) -> String {
    let packed = miniz_oxide::deflate::compress_to_vec(bytes, 6);
    let text = STANDARD.encode(packed);
    format!("<script id=\"{id}\" type=\"application/octet-stream\">{text}</script>\n")
}
