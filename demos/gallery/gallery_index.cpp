#include "demos/gallery/gallery_index.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <sstream>

#include "demos/format/markup_text.h"
#include "demos/page/web_source.h"
#include "demos/system/build_info.h"

namespace carom::demos {

/// The index's files, as the build put them into the program.
const std::vector<WebSource>& gallerySources();

namespace {

constexpr std::array<const char*, 9> kOwnGroups = {"showpieces",
                                                   "the paper",
                                                   "sliding and resting",
                                                   "many contacts",
                                                   "accuracy beside theory",
                                                   "air and water",
                                                   "machines",
                                                   "meshes",
                                                   "large"};
constexpr const char* kRest = "more";

/// "the paper" as an anchor: "the-paper".
std::string anchorOf(const std::string& group) {
  std::string anchor;
  for (const char c : group) anchor += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '-';
  return anchor;
}

/// A scene's name as a title: words instead of hyphens.
std::string titleOf(const std::string& name) {
  std::string title = name;
  std::replace(title.begin(), title.end(), '-', ' ');
  if (!title.empty()) title[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(title[0])));
  return title;
}

/// A link relative to the index.
std::string linkText(const std::string& path) {
  constexpr const char* kHex = "0123456789ABCDEF";
  std::string link;
  for (const char c : path) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) != 0 || c == '/' || c == '-' || c == '_' || c == '.' || c == '~')
      link += c;
    else
      link.append("%").append(1, kHex[byte >> 4]).append(1, kHex[byte & 15]);
  }
  return link;
}

std::string cardOf(const GalleryEntry& entry) {
  std::ostringstream card;
  const std::string title = markupText(titleOf(entry.name));
  card << "<article class=\"card\" data-words=\""
       << markupText(entry.name + " " + entry.description + " " + entry.look_for + " " + entry.group)
       << "\">\n"
       << "<a class=\"picture\" href=\"" << linkText(galleryPage(entry.name)) << "\" aria-label=\"Play "
       << title << "\">"
       << "<picture><source media=\"(prefers-reduced-motion: reduce)\" srcset=\""
       << linkText(galleryStill(entry.name)) << "\"><img loading=\"lazy\" decoding=\"async\" width=\""
       << entry.width << "\" height=\"" << entry.height << "\" alt=\"\" src=\""
       << linkText(galleryPicture(entry.name)) << "\" data-still=\"" << linkText(galleryStill(entry.name))
       << "\"></picture></a>\n"
       << "<h3><a href=\"" << linkText(galleryPage(entry.name)) << "\">" << title << "</a></h3>\n"
       << "<p>" << markupText(entry.description) << "</p>\n";
  if (!entry.look_for.empty()) card << "<p class=\"look\">" << markupText(entry.look_for) << "</p>\n";
  card << "<p class=\"meta\">" << entry.bodies << (entry.bodies == 1 ? " body" : " bodies") << ", "
       << entry.duration_s << " s</p>\n<div class=\"command\"><code>" << markupText(entry.command)
       << "</code><button type=\"button\">copy</button></div>\n</article>\n";
  return card.str();
}

}  // namespace

std::vector<std::string> galleryGroups(std::span<const GalleryEntry> entries) {
  std::vector<std::string> groups, others;
  const auto has = [&](const std::string& group) {
    return std::any_of(entries.begin(), entries.end(),
                       [&](const GalleryEntry& e) { return e.group == group; });
  };
  for (const char* group : kOwnGroups)
    if (has(group)) groups.emplace_back(group);
  for (const GalleryEntry& entry : entries)
    if (entry.group != kRest &&
        std::find(kOwnGroups.begin(), kOwnGroups.end(), entry.group) == kOwnGroups.end() &&
        std::find(others.begin(), others.end(), entry.group) == others.end())
      others.push_back(entry.group);
  std::sort(others.begin(), others.end());
  groups.insert(groups.end(), others.begin(), others.end());
  if (has(kRest)) groups.emplace_back(kRest);
  return groups;
}

std::string galleryIndex(std::span<const GalleryEntry> entries) {
  std::string chips, sections;
  for (const std::string& group : galleryGroups(entries)) {
    const std::string anchor = markupText(anchorOf(group)), title = markupText(titleOf(group));
    std::string cards;
    int count = 0;
    for (const GalleryEntry& entry : entries) {
      if (entry.group != group) continue;
      cards += cardOf(entry);
      ++count;
    }
    chips += "<a href=\"#" + anchor + "\">" + title + " <span>" + std::to_string(count) + "</span></a>\n";
    sections += "<section id=\"" + anchor + "\">\n<h2>" + title + "</h2>\n<div class=\"cards\">\n" + cards +
                "</div>\n</section>\n";
  }
  const std::vector<WebSource>& web = gallerySources();
  const std::size_t count = entries.size();
  return withParts(textOf(web, "index.html"),
                   {{"/*STYLE*/", std::string(textOf(web, "index.css"))},
                    {"<!--COUNT-->", std::to_string(count) + (count == 1 ? " scene" : " scenes")},
                    {"<!--GROUPS-->", chips},
                    {"<!--SCENES-->", sections},
                    {"<!--PROGRAM-->", markupText("carom " + programVersion())},
                    {"/*SCRIPT*/", std::string(textOf(web, "index.js"))}});
}

}  // namespace carom::demos
