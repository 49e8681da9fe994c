#include "demos/frames/frame_outputs.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "demos/format/formatted.h"
#include "demos/format/nearest_name.h"
#include "demos/system/exit_code.h"

namespace carom::demos {
namespace {

using renderer::SurfaceImage;

const std::vector<std::string>& outputNames() {
  static const std::vector<std::string> names{"depth", "normal", "id"};
  return names;
}

std::uint16_t depthSample(float depth_m, const OutputScale& scale) {
  if (std::isinf(depth_m)) return kSkyDepth;
  const double units = static_cast<double>(depth_m) / scale.metresPerUnit();
  return static_cast<std::uint16_t>(std::min<double>(kMostDepth, std::floor(units + 0.5)));
}

std::uint16_t normalSample(float component) {
  const float shifted = 32768.5f + 32767.0f * std::clamp(component, -1.0f, 1.0f);
  return static_cast<std::uint16_t>(shifted);
}

/// From its origin, also of what is drawn in the solid's place.
double reachOf(const Solid& solid) {
  double reach_m = solid.radius();
  for (const Vec3& p_B : solid.surface().mesh.vertices) reach_m = std::max(reach_m, p_B.norm());
  return reach_m;
}

}  // namespace

const std::string& nameOf(FrameOutput output) {
  return outputNames()[static_cast<std::size_t>(output)];
}

std::vector<FrameOutput> readOutputs(const std::string& text) {
  std::vector<FrameOutput> outputs;
  std::istringstream in(text);
  for (std::string word; std::getline(in, word, ',');) {
    const auto found = std::find(outputNames().begin(), outputNames().end(), word);
    if (found == outputNames().end())
      throw UsageError("--aov " + text + ": unknown output \"" + word + "\"" +
                       acceptedNames(word, outputNames()));
    outputs.push_back(static_cast<FrameOutput>(found - outputNames().begin()));
  }
  std::sort(outputs.begin(), outputs.end());
  outputs.erase(std::unique(outputs.begin(), outputs.end()), outputs.end());
  return outputs;
}

OutputScale outputScale(std::span<const renderer::Instance> start, std::span<const Solid> solids,
                        const renderer::Camera& camera) {
  const renderer::CameraAxes axes = renderer::cameraAxes(camera);
  double reach_m = (camera.target - camera.eye).norm();
  for (const renderer::Instance& instance : start) {
    if (instance.checker) continue;
    const double depth_m = (instance.X_WB.position - camera.eye).dot(axes.forward);
    reach_m = std::max(reach_m, depth_m + reachOf(solids[static_cast<std::size_t>(instance.solid)]));
  }
  double decade = 1e-6;
  for (; decade < 1e12; decade *= 10.0)
    for (const double step : {1.0, 2.0, 5.0})
      if (step * decade >= 2.0 * reach_m) return {step * decade};
  return {decade};
}

renderer::Raster outputRaster(FrameOutput output, const SurfaceImage& surfaces, const OutputScale& scale) {
  const bool is_normal = output == FrameOutput::kNormal;
  const std::size_t pixels = surfaces.instance.size();
  renderer::Raster raster{surfaces.depth.width, surfaces.depth.height, is_normal ? 3 : 1, 16, {}};
  raster.samples.resize(pixels * (is_normal ? 3 : 1));
  switch (output) {
    case FrameOutput::kDepth:
      for (std::size_t i = 0; i < pixels; ++i)
        raster.samples[i] = depthSample(surfaces.depth.depth_m[i], scale);
      break;
    case FrameOutput::kNormal:
      for (std::size_t i = 0; i < pixels; ++i)
        for (std::size_t c = 0; c < 3 && surfaces.instance[i] != renderer::kSky; ++c)
          raster.samples[3 * i + c] = normalSample(surfaces.normal_W[i][c]);
      break;
    case FrameOutput::kId:
      for (std::size_t i = 0; i < pixels; ++i)
        raster.samples[i] = static_cast<std::uint16_t>(surfaces.instance[i] + 1);
      break;
  }
  return raster;
}

renderer::PngText outputText(FrameOutput output, const renderer::PngText& frame_text,
                             const OutputScale& scale) {
  renderer::PngText text = frame_text;
  text.emplace_back("Output", nameOf(output));
  switch (output) {
    case FrameOutput::kDepth:
      text.emplace_back("Metres per unit", formatted("%.17g", scale.metresPerUnit()));
      text.emplace_back("Sky", std::to_string(kSkyDepth));
      break;
    case FrameOutput::kNormal:
      text.emplace_back("Encoding", "32768 + 32767 * normal, world frame");
      text.emplace_back("Sky", "0 0 0");
      break;
    case FrameOutput::kId:
      text.emplace_back("Encoding", "1 + place of the body in the scene");
      text.emplace_back("Sky", "0");
      break;
  }
  return text;
}

Json outputsJson(const std::vector<FrameOutput>& outputs, const OutputScale& scale,
                 const std::vector<std::string>& bodies) {
  Json json = Json::object();
  for (const FrameOutput output : outputs) {
    Json meaning;
    switch (output) {
      case FrameOutput::kDepth:
        meaning = Json::object({{"metresPerUnit", scale.metresPerUnit()},
                                {"largest_m", scale.depth_range_m},
                                {"largest", kMostDepth},
                                {"sky", kSkyDepth}});
        break;
      case FrameOutput::kNormal:
        meaning = Json::object(
            {{"zero", 32768}, {"one", 32767}, {"frame", "world"}, {"sky", Json::array({0, 0, 0})}});
        break;
      case FrameOutput::kId: {
        Json names = Json::array();
        for (const std::string& name : bodies) names.push(name);
        meaning = Json::object({{"first", 1}, {"sky", 0}, {"names", std::move(names)}});
        break;
      }
    }
    json.set(nameOf(output), std::move(meaning));
  }
  return json;
}

}  // namespace carom::demos
