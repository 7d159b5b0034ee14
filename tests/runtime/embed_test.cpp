// What facet_embed's script writes; that it compiles and links is shown by every program that
// embeds its kernels.
#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>

namespace {

namespace fs = std::filesystem;

class folder {
 public:
  folder() {
    std::string name = (fs::temp_directory_path() / "facet_embed_XXXXXX").string();
    REQUIRE(mkdtemp(name.data()) != nullptr);
    path = name;
  }
  ~folder() { fs::remove_all(path); }
  fs::path path;
};

/// The bytes of `unsigned char NAME[] = {...};`, but for the last.
std::string array_in(const std::string& text, const std::string& name) {
  std::size_t at = text.find(name + "[] = {");
  REQUIRE(at != text.npos);
  const std::size_t end = text.find('}', at);
  std::string bytes;
  while ((at = text.find("0x", at)) < end) {
    bytes += char(std::stoi(text.substr(at + 2, 2), nullptr, 16));
    at += 2;
  }
  return bytes;
}

}  // namespace

TEST_CASE("any content is embedded byte by byte, in lines of bounded length") {
  std::string every_byte;
  for (int i = 0; i < 256; ++i) every_byte += char(i);
  const std::string nasty = ")\"; )facet\" \\ ${x} $<y> [[ ]] ;; \"\"\" ?\?/ \r\n\t#include <x>";
  const std::map<std::string, std::string> files{{"empty.h", ""},
                                                 {"every_byte.cl", every_byte},
                                                 {"long.cl", std::string(100000, 'x')},
                                                 {"nasty.cl", nasty + nasty}};
  const folder f;
  std::string list;
  for (const auto& [name, text] : files) {
    std::ofstream(f.path / name, std::ios::binary) << text;
    list += (list.empty() ? "" : ";") + (f.path / name).string();
  }
  const fs::path output = f.path / "out.cpp";
  const std::string command = "cmake '-DOUTPUT=" + output.string() +
                              "' -DSYMBOL=some::where::texts '-DFILES=" + list + "' -P '" +
                              FACET_SOURCE_DIR "/host/runtime/embed_write.cmake'";
  REQUIRE(std::system(command.c_str()) == 0);

  std::ifstream in(output, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  int number = 0;
  for (const auto& [name, content] : files) {
    const std::string array = "file_" + std::to_string(number++);
    CHECK(array_in(text, array) == content);
    CHECK(text.find("{\"" + name + "\", text(" + array + ")}") != text.npos);
  }
  CHECK(text.find("namespace some::where {") != text.npos);
  CHECK(text.find("source_tree& texts()") != text.npos);
  std::size_t longest = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    longest = std::max(longest, end - at);
    at = end + 1;
  }
  CHECK(longest <= 120);
}
