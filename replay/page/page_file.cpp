#include "replay/page/page_file.hpp"

#include <algorithm>
#include <string>

#include "replay/page/page_template.hpp"

namespace sesame::replay {

void write_page_file(std::ostream& out, std::string_view data, PageFrom from) {
  std::string page;
  for (const std::string_view part : page_template()) {
    page += part;
  }
  if (from == PageFrom::server) {
    constexpr std::string_view nothing = "default-src 'none';";
    page.insert(page.find(nothing) + nothing.size(), " connect-src 'self';");
  }
  const std::size_t mark = page.find(page_data_mark);
  out << std::string_view{page}.substr(0, mark);
  // In JSON the character that could begin the end of the element stands in texts only.
  for (std::size_t begin = 0; begin < data.size();) {
    const std::size_t end = std::min(data.find('<', begin), data.size());
    out << data.substr(begin, end - begin);
    if (end < data.size()) {
      out << "\\u003c";
    }
    begin = end + 1;
  }
  out << std::string_view{page}.substr(mark + page_data_mark.size());
}

}  // namespace sesame::replay
