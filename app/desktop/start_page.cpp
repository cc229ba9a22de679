#include "app/desktop/start_page.h"

#include <QCoreApplication>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QPushButton>
#include <QRegularExpression>
#include <QResizeEvent>
#include <QToolButton>

#include <algorithm>

namespace sandglass::desktop {

namespace {

constexpr int cardWidth = 220, pictureWidth = 200, pictureHeight = 130; ///< [pixel]
constexpr int mostRecent = 8;

/// The title line of a scene, without reading the rest.
QString titleOf(const QString& file) {
  QFile in(file);
  if (!in.open(QIODevice::ReadOnly)) return {};
  const auto match = QRegularExpression("^title\\s*=\\s*\"([^\"]*)\"", QRegularExpression::MultilineOption)
                         .match(QString::fromUtf8(in.read(4000)));
  return match.captured(1);
}

/// In two lines, as long as they take it.
QString inTwoLines(const QString& text, const QFontMetrics& letters, int width) {
  if (letters.horizontalAdvance(text) <= width) return text + "\n";
  int split = 0;
  for (int at = text.indexOf(' '); at >= 0; at = text.indexOf(' ', at + 1))
    if (letters.horizontalAdvance(text.left(at)) <= width) split = at;
  if (split == 0) return letters.elidedText(text, Qt::ElideRight, width) + "\n";
  return text.left(split) + "\n" + letters.elidedText(text.mid(split + 1), Qt::ElideRight, width);
}

QString samplesFolder() {
  const QString program = QCoreApplication::applicationDirPath();
  for (const char* place : {"/../share/sandglass/sample_runs", "/../../sample_runs", "/../../../sample_runs"})
    if (QFileInfo::exists(program + place)) return QDir::cleanPath(program + place);
  const QString source = SANDGLASS_SAMPLES;
  return QFileInfo::exists(source) ? source : QString();
}

} // namespace

std::vector<Sample> sampleScenes() {
  std::vector<Sample> all;
  const QDir folder(samplesFolder());
  if (samplesFolder().isEmpty()) return all;
  for (const auto& name : folder.entryList(QDir::Dirs | QDir::NoDotAndDotDot, QDir::Name)) {
    const QString file = folder.filePath(name + "/scene.toml");
    if (!QFileInfo::exists(file)) continue;
    const QString title = titleOf(file);
    all.push_back({name, title.isEmpty() ? name : title, file, folder.filePath(name + "/picture.png")});
  }
  return all;
}

StartPage::StartPage(QWidget* parent) : QScrollArea(parent) {
  setObjectName("startPage");
  setWidgetResizable(true);
  setFrameShape(QFrame::NoFrame);
  auto* page = new QWidget;
  page->setObjectName("startPageContent");
  auto* column = new QVBoxLayout(page);
  column->setContentsMargins(28, 22, 28, 22);
  column->setSpacing(12);
  auto* title = new QLabel("Start from a sample");
  title->setProperty("pageTitle", true);
  column->addWidget(title);
  auto* hint = new QLabel(
      "Click one, look at it, change what you like, and press Space to run it. Scenes, runs, files "
      "of frames and saved pictures can be dropped here as well.");
  hint->setWordWrap(true);
  column->addWidget(hint);
  cards_ = new QGridLayout;
  cards_->setSpacing(14);
  column->addLayout(cards_);
  for (const auto& sample : sampleScenes()) {
    auto* card = new QToolButton;
    card->setObjectName("sample." + sample.name);
    card->setAccessibleName(sample.title);
    card->setProperty("card", true);
    card->setToolButtonStyle(Qt::ToolButtonTextUnderIcon);
    card->setFocusPolicy(Qt::StrongFocus);
    QPixmap picture(sample.picture);
    if (picture.isNull()) {
      picture = QPixmap(pictureWidth, pictureHeight);
      picture.fill(QColor(236, 238, 235));
    }
    card->setIconSize({pictureWidth, pictureHeight});
    card->setIcon(picture.scaled(pictureWidth, pictureHeight, Qt::KeepAspectRatio, Qt::SmoothTransformation));
    card->setText(inTwoLines(sample.title, fontMetrics(), pictureWidth));
    card->setToolTip(sample.title);
    card->setFixedWidth(cardWidth);
    connect(card, &QToolButton::clicked, this, [this, file = sample.file] { Q_EMIT sampleChosen(file); });
    all_.push_back(card);
  }
  auto* row = new QHBoxLayout;
  auto* open = new QPushButton("Open...");
  open->setObjectName("startOpen");
  connect(open, &QPushButton::clicked, this, &StartPage::openWanted);
  row->addWidget(open);
  row->addStretch(1);
  column->addLayout(row);
  recentTitle_ = new QLabel("Open lately");
  recentTitle_->setProperty("pageTitle", true);
  column->addWidget(recentTitle_);
  recent_ = new QVBoxLayout;
  recent_->setSpacing(2);
  column->addLayout(recent_);
  column->addStretch(1);
  setWidget(page);
  setRecent({});
  layOut();
}

void StartPage::setRecent(const QStringList& paths) {
  while (auto* item = recent_->takeAt(0)) {
    delete item->widget();
    delete item;
  }
  for (const auto& path : paths.mid(0, mostRecent)) {
    auto* link = new QPushButton(QDir::toNativeSeparators(path));
    link->setFlat(true);
    link->setProperty("link", true);
    link->setCursor(Qt::PointingHandCursor);
    connect(link, &QPushButton::clicked, this, [this, path] { Q_EMIT recentChosen(path); });
    recent_->addWidget(link, 0, Qt::AlignLeft);
  }
  recentTitle_->setVisible(!paths.isEmpty());
}

void StartPage::resizeEvent(QResizeEvent* event) {
  QScrollArea::resizeEvent(event);
  layOut();
}

void StartPage::layOut() {
  const int columns = std::max(1, (viewport()->width() - 42) / (cardWidth + 14));
  if (columns == columns_) return;
  columns_ = columns;
  for (std::size_t k = 0; k < all_.size(); ++k)
    cards_->addWidget(all_[k], static_cast<int>(k) / columns, static_cast<int>(k) % columns, Qt::AlignLeft);
  for (int c = 0; c < 12; ++c)
    cards_->setColumnStretch(c, c == columns ? 1 : 0);
}

} // namespace sandglass::desktop
