//! Trees with defects: each defect is listed with its node and shown in the picture. The stored
//! costs of the best trees are compared with the costs that the exact sweep computes.

use std::fs;

use author::oracle::{scan, sweep};
use framework::scene::Scene;
use serde_json::{Value, json};
use test_support::{Chromium, DESKTOP};
use view::sweep_costs::{SWEEP_COSTS, hash};

use crate::browser::{click, open, text, wait, wait_until_shown};
use crate::harness::{Submission, Viewer, workspace};

const ARGUMENTS: &str = "checkered-teapot --size 24x18 --samples 1";

/// Starts the viewer on the reference with this change to its tree, and waits until the tree has
/// been checked.
fn start(change: &str) -> (Viewer, Value) {
    let submission = Submission::reference();
    submission.change_tree(change);
    let viewer = Viewer::start(&submission, ARGUMENTS);
    // Nothing has to be clicked, because every tree is checked.
    viewer.wait_for(|state| state["has_tree"] == true);
    let tree = viewer.get_json("/tree");
    (viewer, tree)
}

/// Returns the title of each kind of defect and the number of such defects.
fn kinds(tree: &Value) -> Vec<(&str, u64)> {
    let kinds = tree["checkup"]["kinds"].as_array().unwrap().iter();
    let kinds = kinds.map(|kind| (kind["title"].as_str().unwrap(), &kind["count"]));
    kinds
        .map(|(title, count)| (title, count.as_u64().unwrap()))
        .collect()
}

#[test]
fn a_correct_tree_has_no_defects_and_its_cost_is_compared_with_the_best() {
    let (viewer, tree) = start("");
    assert_eq!(kinds(&tree), []);
    let ratio = tree["checkup"]["ratio"].as_f64().unwrap();
    // The large floor makes the first buckets wide.
    assert!((1.0..1.4).contains(&ratio), "{ratio}");
    let (total, cost) = (&tree["cost"], &tree["checkup"]["cost"]);
    let [total, cost] = [total, cost].map(|cost| cost.as_f64().unwrap());
    assert!((total / cost - 1.0).abs() < 1e-3, "{total} {cost}");
    assert_eq!(viewer.wait_for_picture()["notes"], json!([]));
}

#[test]
fn each_defect_of_a_tree_is_named_with_its_node() {
    for (change, title, count, defect) in [
        (
            "let lost = bvh.nodes.iter_mut().find(|node| node.is_leaf() && node.size > 1); \
             lost.unwrap().size -= 1;",
            "Primitives that no ray can hit because they are not in any leaf",
            1..=1,
            "primitive ",
        ),
        (
            "bvh.nodes = bvh.nodes.iter().map(|node| Node { \
             bbox: BBox::new(node.bbox.center(), node.bbox.center()), ..*node }).collect();",
            "Boxes that cause missed hits because they do not contain everything below their nodes",
            1000..=u64::MAX,
            "node 0: ",
        ),
        (
            "bvh.nodes = bvh.nodes.iter().map(|node| Node { \
             bbox: BBox::new(node.bbox.min, node.bbox.max + 1.0), ..*node }).collect();",
            "Boxes that are larger than necessary",
            1000..=u64::MAX,
            "node 0: ",
        ),
        (
            "let all = bvh.nodes[bvh.root].bbox; bvh.nodes.push(Node::leaf(all, 0, 0)); \
             let empty = bvh.nodes.len() - 1; \
             bvh.nodes.push(Node::interior(all, bvh.root, empty)); bvh.root = empty + 1;",
            "Leaves without primitives",
            1..=1,
            "leaf ",
        ),
        (
            "bvh = Self::correct_build(bvh.primitives, 4 * max_leaf_size);",
            "Leaves with too many primitives",
            20..=u64::MAX,
            "leaf ",
        ),
        (
            "bvh = Self::correct_build(bvh.primitives, 1);",
            "Nodes that are split even though their primitives fit in one leaf",
            20..=u64::MAX,
            "node ",
        ),
        (
            "let root = bvh.root; bvh.nodes[root].l = 999_999;",
            "The links do not form a tree, so nothing else was checked",
            1..=1,
            "child l: node 999999 of ",
        ),
    ] {
        let (viewer, tree) = start(change);
        let (found_title, found_count) = kinds(&tree)[0];
        assert_eq!(found_title, title, "{change}");
        assert!(count.contains(&found_count), "{title}: {found_count}");
        let first = &tree["checkup"]["kinds"][0]["defects"][0];
        let text = first["text"].as_str().unwrap();
        assert!(text.starts_with(defect), "{text}");
        let (is_lost, is_no_tree) = (title.contains("not in any leaf"), title.contains("links"));
        assert_eq!(
            first["node"].is_number(),
            !is_lost && !is_no_tree,
            "{title}"
        );
        // The cost of a tree that lacks primitives is meaningless.
        let has_cost = tree["checkup"]["cost"].is_number();
        assert_eq!(has_cost, !is_lost && !is_no_tree, "{title}");
        let state = viewer.wait_for(|state| state["notes"] != json!([]));
        let notes = state["notes"].to_string();
        assert!(notes.contains(title), "{notes}");
    }
}

#[test]
fn a_primitive_in_two_leaves_is_listed_with_them_and_drawn() {
    let change = "let second = bvh.nodes.iter_mut().find(|node| node.is_leaf() && node.start > 0); \
                  let second = second.unwrap(); (second.start, second.size) = (second.start - 1, 2);";
    let (viewer, tree) = start(change);
    let kind = &tree["checkup"]["kinds"];
    let kind = kind.as_array().unwrap().iter();
    let mut kind = kind.filter(|kind| kind["title"] == "Primitives that are in several leaves");
    let defect = &kind.next().unwrap()["defects"][0]["text"];
    let defect = defect.as_str().unwrap();
    assert!(defect.contains(", in leaves "), "{defect}");

    let Some(chromium) = Chromium::start() else {
        return;
    };
    let mut tab = open(&viewer, &chromium, DESKTOP);
    wait_until_shown(&mut tab, "defects");
    let listed = tab.eval("document.getElementById('defects').textContent");
    assert!(listed.as_str().unwrap().contains(defect), "{listed}");
    let cost = text(&mut tab, "#tree-facts");
    assert!(cost.contains("no SAH cost, because"), "{cost}");
    let count_red = "(() => { const canvas = document.getElementById('lines'); \
        const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height); \
        let red = 0; for (let i = 0; i < data.length; i += 4) \
        red += data[i] > 200 && data[i + 1] < 80 && data[i + 2] < 80 && data[i + 3] > 100; \
        return red; })()";
    wait(&mut tab, &format!("{count_red} > 10"));
    click(&mut tab, "#defects input");
    assert_eq!(tab.eval(count_red), 0);
    click(&mut tab, "#defects button");
    wait(&mut tab, &format!("{count_red} > 10"));
    assert_eq!(tab.errors(), [""; 0]);
}

#[test]
fn the_stored_costs_are_those_of_the_exact_sweep_for_every_scene() {
    let entries = fs::read_dir(workspace().join("scenes")).unwrap();
    let paths = entries.map(|entry| entry.unwrap().path());
    let files = paths.filter(|path| path.extension().is_some_and(|kind| kind == "json"));
    let costs = files.map(|file| {
        let scene = Scene::load(&file).unwrap();
        let boxes: Vec<_> = scene.shapes.iter().map(scan::bounds).collect();
        let cost = sweep::cost(&boxes, scene.max_leaf_size);
        (hash(&scene.shapes, scene.max_leaf_size), cost)
    });
    let mut costs: Vec<(String, f64)> = costs.collect();
    costs.sort_by(|a, b| a.0.cmp(&b.0));
    let stored = SWEEP_COSTS.map(|(hash, cost)| (hash.to_owned(), cost));
    let is_close = costs.len() == stored.len()
        && costs
            .iter()
            .zip(&stored)
            .all(|(now, then)| now.0 == then.0 && (now.1 - then.1).abs() <= 1e-4 * now.1);
    assert!(is_close, "write these into sweep_costs.rs: {costs:#?}");
}
