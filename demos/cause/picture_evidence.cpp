#include "demos/cause/picture_evidence.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <set>

#include "renderer/image/image_difference.h"

namespace carom::demos {
namespace {

constexpr char kSkyName[] = "the background";

bool fits(const renderer::Raster& raster, const RecordedShot& shot) {
  return raster.width == shot.width && raster.height == shot.height && !shot.bodies.empty();
}

bool isBeyond(const ComparedPictures& p, std::size_t pixel) {
  const auto channels = static_cast<std::size_t>(p.actual.channels);
  for (std::size_t c = 0; c < channels; ++c) {
    const int a = p.actual.samples[pixel * channels + c], g = p.golden.samples[pixel * channels + c];
    if (std::abs(a - g) > p.tolerance) return true;
  }
  return false;
}

std::string nameBehind(const RecordedPicture& picture, std::size_t pixel) {
  const std::int32_t body = picture.shot.bodies[pixel];
  const auto& bodies = picture.record.bodies;
  return body >= 0 && static_cast<std::size_t>(body) < bodies.size()
             ? bodies[static_cast<std::size_t>(body)].name
             : kSkyName;
}

bool isStatic(const MotionRecord& record, const std::string& name) {
  for (const RecordedBody& body : record.bodies)
    if (body.name == name)
      for (const auto& [fact, text] : body.motion)
        if (fact == "static") return text == "true";
  return name == kSkyName;
}

/// "crate[3], crate[4] and 2 more, and what is around them"
std::string sentence(const std::vector<BodyPixels>& pixels, const MotionRecord& record, long long beyond) {
  std::vector<std::string> movers, others;
  for (const BodyPixels& p : pixels) {
    if (100 * p.pixels < beyond) continue;  // a hundredth: the smoothed edge of a neighbour
    (isStatic(record, p.name) ? others : movers).push_back(p.name);
  }
  std::string text = "the difference lies on ";
  const std::vector<std::string>& named = movers.empty() ? others : movers;
  for (std::size_t i = 0; i < std::min<std::size_t>(named.size(), 3); ++i)
    text += (i == 0 ? "" : ", ") + named[i];
  if (named.size() > 3) text += " and " + std::to_string(named.size() - 3) + " more";
  if (!movers.empty() && !others.empty())
    text += movers.size() == 1 ? " and its shadow or surroundings" : " and their shadows or surroundings";
  return named.empty() ? "" : text;
}

}  // namespace

void addPictureEvidence(const ComparedPictures& p, const RecordedPictures& records, Cause& cause) {
  const bool same_shape = p.actual.width == p.golden.width && p.actual.height == p.golden.height &&
                          p.actual.channels == p.golden.channels && p.actual.bits == p.golden.bits;
  if (!same_shape || !fits(p.actual, records.actual.shot) || !fits(p.golden, records.golden.shot)) return;
  const std::size_t count = records.actual.shot.bodies.size();
  std::map<std::string, long long> pixels;
  long long beyond = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (!isBeyond(p, i)) continue;
    ++beyond;
    const std::string is = nameBehind(records.actual, i), was = nameBehind(records.golden, i);
    ++pixels[is];
    if (was != is) ++pixels[was];
  }
  for (const auto& [name, n] : pixels) cause.pixels.push_back({name, n});
  std::stable_sort(cause.pixels.begin(), cause.pixels.end(),
                   [](const BodyPixels& a, const BodyPixels& b) { return a.pixels > b.pixels; });
  if (2 * beyond > static_cast<long long>(count))
    cause.evidence = "the difference is all over the picture";
  else
    cause.evidence = sentence(cause.pixels, records.golden.record, beyond);
}

}  // namespace carom::demos
