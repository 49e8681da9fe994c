#include "engine/broad_phase/bounds_tree.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace carom {
namespace {

constexpr double kWorn = 2.0;  // times the surface that was built: queries cost in proportion to it

// Half the surface: what a random query meets is in proportion.
double surface(const Bounds& bounds) {
  const Vec3 size = bounds.high - bounds.low;
  return size.x() * size.y() + size.y() * size.z() + size.z() * size.x();
}

}  // namespace

void BoundsTree::setLeaves(std::span<const Bounds> bounds) {
  for (std::size_t i = 0; i < bounds.size(); ++i) nodes_[i].bounds = bounds[i];
}

void BoundsTree::build(std::span<const Bounds> bounds) {
  leaves_ = static_cast<int>(bounds.size());
  nodes_.assign(bounds.empty() ? 0 : 2 * bounds.size() - 1, {});
  setLeaves(bounds);
  root_ = -1;
  if (bounds.empty()) return;
  std::vector<int> things(bounds.size());
  std::iota(things.begin(), things.end(), 0);
  int next = leaves_;
  root_ = buildNode(things, next);
  built_surface_ = fitAll();
}

void BoundsTree::moveAll(std::span<const Bounds> bounds) {
  if (static_cast<int>(bounds.size()) != leaves_) {
    build(bounds);
    return;
  }
  setLeaves(bounds);
  if (!(fitAll() <= kWorn * built_surface_)) build(bounds);
}

// Children first. Returns the surface of all nodes above leaves.
double BoundsTree::fitAll() {
  double sum = 0.0;
  const auto firstLeafBelow = [&](int i) {
    while (!isLeaf(i)) i = node(i).children[0];
    return i;
  };
  for (int i = root_ < 0 ? -1 : firstLeafBelow(root_); i >= 0 && node(i).parent >= 0;) {
    const int parent = node(i).parent;
    if (side(i) == 0) {
      i = firstLeafBelow(node(parent).children[1]);
      continue;
    }
    fit(parent);
    sum += surface(node(parent).bounds);
    i = parent;
  }
  return sum;
}

// The lower half of the things goes to the first child: as deep as the logarithm of their number.
int BoundsTree::buildNode(std::span<int> things, int& next) {
  if (things.size() == 1) return things.front();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Bounds begins{Vec3::Constant(kInfinity), Vec3::Constant(-kInfinity)};
  for (const int i : things) begins = together(begins, {node(i).bounds.low, node(i).bounds.low});
  Eigen::Index axis = 0;
  (begins.high - begins.low).maxCoeff(&axis);
  const auto middle = static_cast<std::ptrdiff_t>(things.size() / 2);
  std::nth_element(things.begin(), things.begin() + middle, things.end(), [&](int i, int j) {
    const double low_i = node(i).bounds.low[axis];
    const double low_j = node(j).bounds.low[axis];
    return low_i < low_j || (low_i == low_j && i < j);
  });
  const int built = next++;
  link(built, 0, buildNode(things.first(things.size() / 2), next));
  link(built, 1, buildNode(things.subspan(things.size() / 2), next));
  fit(built);
  rotate(built);
  return built;
}

void BoundsTree::fit(int i) {
  const Node& first = node(node(i).children[0]);
  const Node& second = node(node(i).children[1]);
  node(i).bounds = together(first.bounds, second.bounds);
}

// No parent: the child is the root.
void BoundsTree::link(int parent, int side, int child) {
  node(child).parent = parent;
  if (parent < 0)
    root_ = child;
  else
    node(parent).children[static_cast<std::size_t>(side)] = child;
}

// Its sibling takes the place of the node above both.
void BoundsTree::takeOut(int thing) {
  const int above = node(thing).parent;
  const int sibling = node(above).children[static_cast<std::size_t>(1 - side(thing))];
  const int parent = node(above).parent;
  link(parent, parent < 0 ? 0 : side(above), sibling);
  refitFrom(parent);
}

// Down to where a new node above bounds and sibling adds least to the surfaces of all nodes.
int BoundsTree::bestSibling(const Bounds& bounds) const {
  int best = root_;
  while (!isLeaf(best)) {
    const double here = surface(together(node(best).bounds, bounds));
    const double inherited = here - surface(node(best).bounds);  // by all that is below
    const auto below = [&](int child) {
      const double grown = surface(together(node(child).bounds, bounds)) + inherited;
      return isLeaf(child) ? grown : grown - surface(node(child).bounds);
    };
    const std::array<double, 2> cost{below(node(best).children[0]), below(node(best).children[1])};
    if (here <= cost[0] && here <= cost[1]) break;
    best = node(best).children[cost[1] < cost[0] ? 1 : 0];
  }
  return best;
}

// A child of the node changes places with a child of the other where that makes the other smaller most.
void BoundsTree::rotate(int i) {
  double most = 0.0;
  int down = -1, up = -1;
  for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
    const int other = node(i).children[1 - side];
    if (isLeaf(other)) continue;
    for (const std::size_t stays : {std::size_t{0}, std::size_t{1}}) {
      const Bounds fitted =
          together(node(node(i).children[side]).bounds, node(node(other).children[stays]).bounds);
      const double gain = surface(node(other).bounds) - surface(fitted);
      if (!(gain > most)) continue;
      most = gain;
      down = node(i).children[side];
      up = node(other).children[1 - stays];
    }
  }
  if (down < 0) return;
  const int other = node(up).parent;
  const int side_down = side(down), side_up = side(up);
  link(i, side_down, up);
  link(other, side_up, down);
  fit(other);
}

void BoundsTree::refitFrom(int i) {
  for (; i >= 0; i = node(i).parent) {
    fit(i);
    rotate(i);
  }
}

void BoundsTree::move(int thing, const Bounds& bounds) {
  if (leaves_ == 1) {
    node(thing).bounds = bounds;
    return;
  }
  const int freed = node(thing).parent;
  takeOut(thing);
  node(thing).bounds = bounds;
  const int sibling = bestSibling(bounds);
  const int parent = node(sibling).parent;
  link(parent, parent < 0 ? 0 : side(sibling), freed);
  link(freed, 0, sibling);
  link(freed, 1, thing);
  refitFrom(freed);
}

void BoundsTree::grow(int thing, const Bounds& bounds) {
  for (int i = thing; i >= 0 && !node(i).bounds.contains(bounds); i = node(i).parent)
    node(i).bounds = together(node(i).bounds, bounds);
}

int BoundsTree::find(const Bounds& bounds, std::vector<int>& found) const {
  found.clear();
  int visited = 0;
  for (int i = root_; i >= 0;) {
    ++visited;
    const bool meets = node(i).bounds.overlaps(bounds);
    if (meets && !isLeaf(i)) {
      i = node(i).children[0];
      continue;
    }
    if (meets) found.push_back(i);
    // On to the next that is not below this one.
    while (node(i).parent >= 0 && side(i) == 1) i = node(i).parent;
    i = node(i).parent >= 0 ? node(node(i).parent).children[1] : -1;
  }
  return visited;
}

}  // namespace carom
