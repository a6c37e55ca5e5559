//! The nodes of a glTF, which must be trees. They are not filtered, but viewers of a file whose
//! nodes contain themselves may never end.

use serde_json::Value;

use crate::failure::Result;

/// Returns an error for a node with two parents, or that contains itself.
pub(super) fn check(nodes: &[Value]) -> Result<()> {
    let children = |node: usize| {
        let list = nodes[node].get("children").and_then(Value::as_array).map_or(&[][..], Vec::as_slice);
        list.iter().map(|child| child.as_u64().and_then(|child| usize::try_from(child).ok()))
    };
    let mut parents = vec![0_u32; nodes.len()];
    for (node, child) in (0..nodes.len()).flat_map(|node| children(node).map(move |child| (node, child))) {
        let parents = child.and_then(|child| parents.get_mut(child));
        *parents.ok_or_else(|| format!("node {node} has a child that does not exist"))? += 1;
    }
    if let Some(node) = parents.iter().position(|parents| *parents > 1) {
        return Err(format!("node {node} has several parents").into());
    }
    let mut found = vec![false; nodes.len()];
    let mut open: Vec<usize> = (0..nodes.len()).filter(|node| parents[*node] == 0).collect();
    while let Some(node) = open.pop() {
        found[node] = true;
        open.extend(children(node).flatten());
    }
    match found.iter().position(|found| !found) {
        Some(node) => Err(format!("node {node} contains itself").into()),
        None => Ok(()),
    }
}
