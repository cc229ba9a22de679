#pragma once
// One tab of the window: what is open in it and how it is looked at.

#include "app/desktop/session.h"
#include "vis/view.h"

#include <QUndoStack>

#include <memory>
#include <optional>
#include <string>

namespace sandglass::desktop {

struct Document {
  explicit Document(const SessionOptions& options) : session(std::make_unique<Session>(options)) {}

  std::unique_ptr<Session> session;
  vis::View view;
  vis::View kept;                    ///< the view before the change that goes on; what undo goes back to
  FramePtr preview;                  ///< of the scene, while it has no frames
  std::optional<Scene> previewScene; ///< of a sweep's run, whose last frame the preview is
  FramePtr shown;                    ///< null until a picture is there
  QString sceneText;                 ///< as edited; the session has the last sound one
  std::optional<std::size_t> chosen; ///< frame, while another tab is shown
  std::int64_t grain = -1;           ///< picked
  bool grainBeside = false;          ///< in the right half of the picture
  Document* beside = nullptr;        ///< another tab, whose run is the right half of the picture
  FramePtr shownBeside;              ///< of it
  bool columnsOffered = false;       ///< the dialog for its columns was there once
  QUndoStack undo;
};

/// What tells its run from others: the name of the folder, or of the file.
std::string runName(const Document& document);

} // namespace sandglass::desktop
