#pragma once
// Changes that can be taken back. What follows a change of the same kind at once belongs to it.

#include "vis/view.h"

#include <QElapsedTimer>
#include <QString>
#include <QUndoCommand>

#include <functional>

namespace sandglass::desktop {

/// A value that goes from `before` to `after`; `apply` is called by undo and redo, not when it is pushed.
template <class T> class ChangeCommand : public QUndoCommand {
public:
  /// Commands of the same `id` and `what` within `together` milliseconds become one.
  ChangeCommand(int id, const QString& what, T before, T after, std::function<void(const T&)> apply,
                qint64 together)
      : QUndoCommand(what), id_(id), before_(std::move(before)), after_(std::move(after)),
        apply_(std::move(apply)), together_(together) {
    since_.start();
  }
  int id() const override { return id_; }
  void undo() override { apply_(before_); }
  void redo() override {
    if (done_) apply_(after_);
    done_ = true;
  }
  bool mergeWith(const QUndoCommand* next) override {
    const auto* other = dynamic_cast<const ChangeCommand*>(next);
    if (!other || other->text() != text() || since_.elapsed() > together_) return false;
    after_ = other->after_;
    since_.restart();
    return true;
  }

private:
  int id_;
  T before_, after_;
  std::function<void(const T&)> apply_;
  qint64 together_;
  QElapsedTimer since_;
  bool done_ = false;
};

} // namespace sandglass::desktop
