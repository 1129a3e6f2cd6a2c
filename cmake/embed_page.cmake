# Writes a file of HTML into a C++ source, in pieces: compilers need not take longer literals than 65,536 characters.
#   cmake -D PAGE=page.html -D OUT=page_text.cpp -P embed_page.cmake
# The page is ASCII without backslashes at the ends of lines and without the delimiter below; build.mjs sees to that.
file(READ "${PAGE}" text)
string(LENGTH "${text}" length)
set(pieces "")
set(begin 0)
while(begin LESS length)
  string(SUBSTRING "${text}" ${begin} 60000 piece)
  string(APPEND pieces "    R\"sesame_page(${piece})sesame_page\"sv,\n")
  math(EXPR begin "${begin} + 60000")
endwhile()
file(WRITE "${OUT}.new" "#include \"replay/page/page_template.hpp\"

namespace sesame::replay {
namespace {

using std::string_view_literals::operator\"\"sv;  // knows its length, so no compiler has to count

constexpr std::string_view pieces[] = {
${pieces}};

}  // namespace

std::span<const std::string_view> page_template() { return pieces; }

}  // namespace sesame::replay
")
file(COPY_FILE "${OUT}.new" "${OUT}" ONLY_IF_DIFFERENT)  # so that nothing is compiled again for nothing
