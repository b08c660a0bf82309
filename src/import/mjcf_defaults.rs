//! Default classes of MJCF: what an element says that it does not write itself.

use std::borrow::Cow;
use std::collections::BTreeMap;

use crate::scene::XmlElement;

/// All classes by name. The root's own is `main`.
#[derive(Default)]
pub(super) struct Defaults<'a> {
    classes: BTreeMap<String, Class<'a>>,
}

#[derive(Default)]
struct Class<'a> {
    parent: Option<String>,
    /// Each with the elements that it sets attributes of.
    settings: Vec<XmlElement<'a>>,
}

const MAIN: &str = "main";

impl<'a> Defaults<'a> {
    pub fn of(root: XmlElement<'a>) -> Self {
        let mut defaults = Self::default();
        for el in root.children().filter(|child| child.name() == "default") {
            defaults.read(el, None);
        }
        defaults
    }

    fn read(&mut self, el: XmlElement<'a>, parent: Option<&str>) {
        let name = el.attribute("class").map_or(MAIN.to_owned(), Cow::into_owned);
        let class = self.classes.entry(name.clone()).or_default();
        class.parent = parent.filter(|parent| *parent != name).map(str::to_owned);
        class.settings.extend(el.children().filter(|child| child.name() != "default"));
        for child in el.children().filter(|child| child.name() == "default") {
            self.read(child, Some(&name));
        }
    }

    /// What an element says, or its class (else `outer`, that of the bodies around it) does for it.
    pub fn attribute(&self, el: XmlElement<'a>, outer: Option<&str>, name: &str) -> Option<Cow<'a, str>> {
        if let Some(own) = el.attribute(name) {
            return Some(own);
        }
        let class = el.attribute("class");
        let mut at = class.as_deref().or(outer).unwrap_or(MAIN);
        // Classes are nested at most as deep as elements.
        for _ in 0..64 {
            let class = self.classes.get(at)?;
            let said = class.settings.iter().filter(|setting| setting.name() == el.name());
            if let Some(value) = said.filter_map(|setting| setting.attribute(name)).next_back() {
                return Some(value);
            }
            at = class.parent.as_deref()?;
        }
        None
    }
}
