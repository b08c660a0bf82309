//! Keeps a view's draw list until something it depends on changes.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use super::{DrawList, ViewInput, build_draw_list};

/// One view's last draw list. Views that show the same thing need one each.
#[derive(Debug, Default)]
pub struct ListCache {
    key: Option<Key>,
    list: Option<Arc<DrawList>>,
}

/// What a picture depends on. The scene by the caller's revision, the frame by its own.
#[derive(Debug, PartialEq)]
struct Key {
    scene_revision: u64,
    frame_revision: Option<u64>,
    camera: super::Camera,
    viewport: super::Viewport,
    overlays: super::OverlaySet,
    theme: super::Theme,
    selection: Vec<crate::scene::NodeKey>,
    hovered: Option<crate::scene::NodeKey>,
    inside: Option<crate::scene::NodeKey>,
    highlighted: Option<u64>,
}

impl Key {
    fn of(input: &ViewInput<'_>, scene_revision: u64) -> Self {
        Self {
            scene_revision,
            frame_revision: input.frame.map(|frame| frame.revision),
            camera: input.camera,
            viewport: input.viewport,
            overlays: input.overlays,
            theme: input.theme,
            selection: input.selection.to_vec(),
            hovered: input.hovered,
            inside: input.inside,
            highlighted: input.highlighted.map(|row| row.event.seq),
        }
    }
}

/// So many balls and plates are drawn in all views at once: without a graphics card that takes about 10 ms a view.
const AT_ONCE: usize = 1000;

/// Numbers draw lists over all views, so that a renderer can tell any two apart.
static NEXT_REVISION: AtomicU64 = AtomicU64::new(1);

impl ListCache {
    /// The draw list of `input`; the same one as long as nothing changed. `scene_revision` must differ
    /// whenever `input.scene` does.
    pub fn get(&mut self, input: &ViewInput<'_>, scene_revision: u64) -> Arc<DrawList> {
        let key = Key::of(input, scene_revision);
        match &self.list {
            Some(list) if self.key.as_ref() == Some(&key) => list.clone(),
            _ => {
                let list = self.numbered(build_draw_list(input));
                (self.key, self.list) = (Some(key), Some(list.clone()));
                list
            }
        }
    }

    /// Whether the list that is kept shows just this.
    pub fn knows(&self, input: &ViewInput<'_>, scene_revision: u64) -> bool {
        self.key.as_ref() == Some(&Key::of(input, scene_revision))
    }

    /// The list that a large scene showed last, while another view has its turn; `None` where there is none, or where
    /// making the list takes no time to speak of.
    pub fn kept(&self) -> Option<Arc<DrawList>> {
        self.list.clone().filter(|list| list.spheres.len() + list.plates.len() > AT_ONCE)
    }

    /// The very list from before if the new one shows the same: drawing it again takes longer than comparing.
    fn numbered(&self, mut new: DrawList) -> Arc<DrawList> {
        if let Some(old) = &self.list {
            new.revision = old.revision;
            if **old == new {
                return old.clone();
            }
        }
        new.revision = NEXT_REVISION.fetch_add(1, Ordering::Relaxed);
        Arc::new(new)
    }
}
