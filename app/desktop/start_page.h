#pragma once
// What the window shows before anything is open: sample scenes as pictures, and what was open lately.

#include <QGridLayout>
#include <QLabel>
#include <QScrollArea>
#include <QStringList>
#include <QVBoxLayout>

#include <vector>

namespace sandglass::desktop {

/// A scene to start from.
struct Sample {
  QString name, title, file; ///< "hopper_glass", the scene's title, its scene.toml
  QString picture;           ///< beside it; may be missing
};

/// In the folder sample_runs of the source tree or of the installation; none when there is no such folder.
std::vector<Sample> sampleScenes();

class StartPage : public QScrollArea {
  Q_OBJECT
public:
  explicit StartPage(QWidget* parent = nullptr);
  void setRecent(const QStringList& paths);

Q_SIGNALS:
  void sampleChosen(const QString& file);
  void recentChosen(const QString& path);
  void openWanted();

protected:
  void resizeEvent(QResizeEvent* event) override;

private:
  void layOut();
  QGridLayout* cards_;
  std::vector<QWidget*> all_;
  QVBoxLayout* recent_;
  QLabel* recentTitle_;
  int columns_ = 0;
};

} // namespace sandglass::desktop
