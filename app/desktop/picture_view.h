#pragma once
// The picture in the middle of the window. Paints the newest finished image and turns mouse moves into camera
// moves; never draws with VTK itself. Left button: orbit; right or middle button, or left with Shift: pan;
// wheel: zoom; a click picks a grain; a double click fits.

#include "app/desktop/drawing_thread.h"

#include <QTimer>
#include <QWidget>

namespace sandglass::desktop {

class PictureView : public QWidget {
  Q_OBJECT
public:
  explicit PictureView(QWidget* parent = nullptr);

  void show(Picture picture);
  /// Back to the hint that is shown while nothing is open.
  void clear();
  void setHint(const QString& title, const QString& text);

  const QImage& image() const { return picture_.image; }
  std::uint64_t pictures() const { return pictures_; } ///< shown so far
  QSize pixels() const { return size() * devicePixelRatioF(); }

  /// The camera is set by others: a wheel that still turns does not set it again.
  void forgetWheel() { settle_.stop(); }

  // The camera moves of the keyboard; angles in degrees, shares of the view height.
  void orbitBy(double azimuth, double elevation);
  void zoomBy(double factor);
  void panBy(double right, double up);

Q_SIGNALS:
  void cameraMoved(const vis::Camera& camera, bool interactive);
  void resized();
  void clicked(QPoint pixel);
  void rectangleDrawn(QRect pixels); ///< with Ctrl held
  void fitWanted();

protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;

private:
  void move(const vis::Camera& camera, bool interactive);
  void paintHint(QPainter& painter);

  Picture picture_;
  vis::Camera camera_; ///< ahead of the picture while the mouse moves
  std::uint64_t pictures_ = 0;
  QString hintTitle_, hintText_;
  QPoint pressed_, last_;
  bool dragging_ = false, drawsRectangle_ = false;
  QTimer settle_; ///< after the last turn of the wheel
};

} // namespace sandglass::desktop
