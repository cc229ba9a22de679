#include "vis/gl/vtk_messages.h"

#include <vtkLogger.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>

#include <mutex>
#include <utility>

namespace sandglass::vis {

namespace {

std::mutex guard;
std::string firstError;

class Keeper : public vtkOutputWindow {
public:
  static Keeper* New();
  vtkTypeMacro(Keeper, vtkOutputWindow);
  void DisplayText(const char*) override {}
  void DisplayErrorText(const char* text) override {
    const std::lock_guard lock(guard);
    if (firstError.empty()) firstError = text;
  }
  void DisplayWarningText(const char*) override {}
  void DisplayGenericWarningText(const char*) override {}
  void DisplayDebugText(const char*) override {}
};
vtkStandardNewMacro(Keeper);

} // namespace

void keepVtkMessages() {
  static const bool once = [] {
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF); // readers report through it as well
    vtkOutputWindow::SetInstance(vtkSmartPointer<Keeper>::New());
    return true;
  }();
  static_cast<void>(once);
}

std::string takeVtkError() {
  const std::lock_guard lock(guard);
  return std::exchange(firstError, "");
}

} // namespace sandglass::vis
