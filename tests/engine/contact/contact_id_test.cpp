// Names of contact points: all different, and the same from both sides.

#include "engine/contact/contact_id.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

namespace carom {
namespace {

std::vector<Feature> someFeatures() {
  std::vector<Feature> features;
  for (const FeatureKind kind : {FeatureKind::kVertex, FeatureKind::kEdge, FeatureKind::kFace})
    for (const int index :
         {-1, 0, 1, 2, 3, 7, 8, 63, 64, 199, 200, 65535, 65536, (1 << 29) - 3, (1 << 29) - 2})
      features.push_back({kind, index});
  return features;
}

TEST(ContactId, DiffersForDifferentPairsAndRoles) {
  std::set<std::uint64_t> ids;
  std::size_t count = 0;
  for (const Feature& a : someFeatures())
    for (const Feature& b : someFeatures())
      for (const PointRole role : {PointRole::kCorner, PointRole::kClosest}) {
        ids.insert(contactId({a, b}, role));
        ++count;
      }
  EXPECT_EQ(ids.size(), count);
}

TEST(ContactId, SymmetricKey_IsTheSameFromBothSidesAndForNoOtherPair) {
  std::set<std::pair<std::uint64_t, std::uint64_t>> keys;
  const std::vector<Feature> features = someFeatures();
  for (const Feature& a : features)
    for (const Feature& b : features) {
      EXPECT_EQ(symmetricKey({a, b}), symmetricKey(swappedPair({a, b})));
      keys.insert(symmetricKey({a, b}));
    }
  EXPECT_EQ(keys.size(), features.size() * (features.size() + 1) / 2);
}

}  // namespace
}  // namespace carom
