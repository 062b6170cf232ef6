// Prints the cuts of a job in JSON Lines as blocks, in C++17, with from_chars, to_chars, an input buffer and an output buffer.
#include <charconv>
#include <cstdio>
#include <cstring>
#include <string>

static std::string last[4];

static void word(std::string &block, int slot, double value) {
  char text[40];
  char *end = std::to_chars(text, text + sizeof text, value, std::chars_format::fixed, 4).ptr;
  while (end[-1] == '0') --end;
  std::string digits(text, end - text);
  if (digits == "0." || digits == "-0.") digits = "0";
  else if (digits.compare(0, 2, "0.") == 0) digits.erase(0, 1);
  else if (digits.compare(0, 3, "-0.") == 0) digits.erase(1, 1);
  if (digits == last[slot]) return;
  if (!block.empty()) block += ' ';
  block += "XYZF"[slot];
  block += digits;
  last[slot] = std::move(digits);
}

int main(int, char **arguments) {
  std::FILE *file = std::fopen(arguments[1], "rb");
  if (!file) return 2;
  // the last bytes are written after the end of main
  static char in[256 * 1024], out[64 * 1024];
  std::setvbuf(file, in, _IOFBF, sizeof in);
  std::setvbuf(stdout, out, _IOFBF, sizeof out);
  char line[512];
  std::string block = "G1";
  double feed = 1500;
  while (std::fgets(line, sizeof line, file)) {
    if (std::strncmp(line, "{\"line\":[", 9) != 0) continue;
    const char *at = line + 9, *end = line + std::strlen(line);
    double to[3];
    for (double &value : to) at = std::from_chars(at, end, value).ptr + 1;
    if (*at == ',') std::from_chars(at + 8, end, feed);
    for (int axis = 0; axis < 3; ++axis) word(block, axis, to[axis]);
    word(block, 3, feed);
    block += '\n';
    std::fwrite(block.data(), 1, block.size(), stdout);
    block.clear();
  }
}
