#include "vis/text_style.h"

#include <filesystem>

namespace sandglass::vis {

void setFont(vtkTextProperty* text, int size, bool bold) {
  static const std::string regular = SANDGLASS_FONT_FOLDER "/DejaVuSans.ttf";
  static const std::string heavy = SANDGLASS_FONT_FOLDER "/DejaVuSans-Bold.ttf";
  static const bool installed = std::filesystem::exists(regular) && std::filesystem::exists(heavy);
  if (installed) {
    text->SetFontFamily(VTK_FONT_FILE);
    text->SetFontFile((bold ? heavy : regular).c_str());
  } else {
    text->SetFontFamilyToArial();
    text->SetBold(bold);
  }
  text->SetFontSize(size);
  text->ItalicOff();
  text->ShadowOff();
}

std::array<double, 3> inkOn(const std::array<double, 3>& background, double strength) {
  const double luma = 0.299 * background[0] + 0.587 * background[1] + 0.114 * background[2];
  const double full = luma > 0.5 ? 0 : 1;
  std::array<double, 3> ink{};
  for (int k = 0; k < 3; ++k)
    ink[k] = background[k] + strength * (full - background[k]);
  return ink;
}

} // namespace sandglass::vis
