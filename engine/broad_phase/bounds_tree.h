#pragma once
// A bounding volume hierarchy over bounds that come one by one to other places: a binary tree whose leaves
// are the things, and that is never built anew for the few that move. What moves is put where the surface of
// the nodes above it grows least, and on the way back up a node changes places with the child of its sibling
// where that makes the sibling smaller (C. Ericson, Real-Time Collision Detection, 2005, 6.3.2 and 6.4; A.
// Kensler, Tree rotations for improving bounding volume hierarchies, 2008). Where it splits decides what a
// query costs, never what it finds. Tested in tests/engine/broad_phase/bounds_tree_test.cpp.

#include <array>
#include <span>
#include <vector>

#include "engine/broad_phase/candidate_pairs.h"

namespace carom {

class BoundsTree {
 public:
  /// Splits at medians, along the axis on which the bounds are spread most. Cost O(n log n).
  void build(std::span<const Bounds> bounds);
  /// Gives all things other bounds. Keeps its shape, O(n), while its nodes are about as small as when it was
  /// built last; then it is built anew.
  void moveAll(std::span<const Bounds> bounds);
  int size() const { return leaves_; }
  const Bounds& bounds(int thing) const { return nodes_[static_cast<std::size_t>(thing)].bounds; }
  /// Gives a thing other bounds. Cost about O(log n).
  void move(int thing, const Bounds& bounds);
  /// Makes the bounds of a thing hold these too. Cost about O(log n).
  void grow(int thing, const Bounds& bounds);
  /// All things whose bounds overlap these, in no order. Returns how many nodes it has looked at, which is
  /// what it costs: about O(log n + found).
  int find(const Bounds& bounds, std::vector<int>& found) const;

 private:
  struct Node {
    Bounds bounds;
    int parent = -1;
    std::array<int, 2> children{-1, -1};
  };

  Node& node(int i) { return nodes_[static_cast<std::size_t>(i)]; }
  const Node& node(int i) const { return nodes_[static_cast<std::size_t>(i)]; }
  bool isLeaf(int i) const { return i < leaves_; }
  int side(int i) const { return node(node(i).parent).children[1] == i ? 1 : 0; }
  void setLeaves(std::span<const Bounds> bounds);
  int buildNode(std::span<int> things, int& next);
  void fit(int i);
  double fitAll();
  void link(int parent, int side, int child);
  void takeOut(int thing);
  int bestSibling(const Bounds& bounds) const;
  void rotate(int i);
  void refitFrom(int i);

  int leaves_ = 0;
  int root_ = -1;
  double built_surface_ = 0.0;  ///< Of all nodes above leaves, when it was built.
  std::vector<Node> nodes_;     ///< The leaves are the first, by thing; then come those above them.
};

}  // namespace carom
