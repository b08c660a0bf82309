//! Groups with names: cosmetic, listed as folders in the tree, nested by `/`.

use super::plan::{Given, Plan};
use crate::scene::{BodyChange, Edit, ForceChange, Names};

/// Gathers the selection in a new group; inside the one that all of it is in already.
pub fn group(given: &Given<'_>) -> Plan {
    let scene = given.scene;
    let of_bodies = scene.bodies.iter().filter_map(|body| body.group.as_deref());
    let groups = of_bodies.chain(scene.forces.iter().filter_map(|force| force.group.as_deref()));
    let (bodies, forces) = (given.bodies(), given.forces());
    let mut parents = bodies.iter().map(|body| &body.group).chain(forces.iter().map(|force| &force.group));
    let common = parents.next().cloned().flatten();
    let common = common.filter(|common| parents.all(|group| group.as_deref() == Some(common)));
    let wanted = common.map_or("group".to_owned(), |common| format!("{common}/group"));
    let name = Names::new(groups).take(&wanted);
    Plan::new(format!("Group {} objects", given.keys.len()), set(given, Some(&name)))
}

/// Takes the selection out of its groups.
pub fn ungroup(given: &Given<'_>) -> Plan {
    Plan::new(format!("Ungroup {} objects", given.keys.len()), set(given, None))
}

/// Puts what is given into a group, or with `None` out of all; what is there already stays untouched.
pub fn regroup(given: &Given<'_>, to: Option<&str>) -> Plan {
    let edits = set(given, to);
    let objects = if edits.len() == 1 { "object" } else { "objects" };
    let label = match to {
        Some(group) => format!("Move {} {objects} into {group}", edits.len()),
        None => format!("Move {} {objects} out of groups", edits.len()),
    };
    Plan::new(label, edits)
}

fn set(given: &Given<'_>, group: Option<&str>) -> Vec<Edit> {
    let group = group.map(str::to_owned);
    let forces = given
        .forces()
        .into_iter()
        .filter(|force| force.group != group)
        .map(|force| Edit::Force { key: force.key, change: ForceChange::Group(group.clone()) });
    let bodies = given
        .bodies()
        .into_iter()
        .filter(|body| body.group != group)
        .map(|body| Edit::Body { key: body.key, change: BodyChange::Group(group.clone()) });
    forces.chain(bodies).collect()
}

/// Gives a group, with all groups inside it, another name.
pub fn rename_group(given: &Given<'_>, from: &str, to: &str) -> Plan {
    let renamed = |group: &Option<String>| {
        let rest = group.as_deref()?.strip_prefix(from)?;
        (rest.is_empty() || rest.starts_with('/')).then(|| format!("{to}{rest}"))
    };
    let forces = given.scene.forces.iter().filter_map(|force| {
        let group = renamed(&force.group)?;
        Some(Edit::Force { key: force.key, change: ForceChange::Group(Some(group)) })
    });
    let bodies = given.scene.bodies.iter().filter_map(|body| {
        let group = renamed(&body.group)?;
        Some(Edit::Body { key: body.key, change: BodyChange::Group(Some(group)) })
    });
    Plan::new(format!("Rename {from}"), forces.chain(bodies).collect())
}
