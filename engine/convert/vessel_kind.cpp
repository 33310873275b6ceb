#include <algorithm>
#include <array>
#include <initializer_list>

#include "convert/source.h"
#include "core/name_words.h"

// The one place that says what names, numbers and colours mean for a vessel's kind.
namespace vasa {
namespace {

// Its words with spaces around each, so that they are found whole.
std::string spaced(std::string_view text) {
  std::string words = " ";
  for (const std::string& word : nameWords(text)) words += word + ' ';
  return words;
}

template <std::size_t N>
bool hasAny(const std::string& text, const std::array<std::string_view, N>& words) {
  return std::ranges::any_of(words, [&](std::string_view word) { return text.find(word) != text.npos; });
}

// "A. femoralis", "Vv. hepaticae", "v_femoralis": anatomists' short forms, before a word that is Latin by its
// ending where no blank stands between. @return a, aa, v, vv, m, n ...; empty where it begins with none
std::string_view shortForm(std::string_view raw, std::string_view words) {
  const std::size_t end = raw.find_first_of("._");
  if (end == raw.npos || end == 0 || end > 2 || end + 1 >= raw.size() || words.size() < end + 3) return {};
  const std::string_view rest = words.substr(end + 2), next = rest.substr(0, rest.find(' '));
  static constexpr std::array<std::string_view, 10> kLatin{"alis", "aris", "otis", "ae",  "ica",
                                                           "aca",  "avia", "tea",  "ena", "cava"};
  const bool latin =
      std::ranges::any_of(kLatin, [&](std::string_view ending) { return next.ends_with(ending); });
  const bool spoken = raw[end] == '.' && raw[end + 1] == ' ';  // "V. jug. int."
  const bool word = next.size() >= (spoken ? 3 : 4) &&
                    std::ranges::all_of(next, [](char c) { return c >= 'a' && c <= 'z'; });
  return word && (latin || spoken) ? words.substr(1, end) : std::string_view{};
}

// "M. biceps", "N. vagus", which are masculine; not of main, middle and new: "M. media", "N. coronaria", "M.
// sup".
bool isMuscleOrNerve(std::string_view raw, std::string_view words) {
  const std::string_view form = shortForm(raw, words);
  if (form.empty() || raw[form.size()] != '.' || (form != "m" && form != "mm" && form != "n" && form != "nn"))
    return false;
  const std::string_view rest = words.substr(form.size() + 2), next = rest.substr(0, rest.find(' '));
  return next.size() > 3 && next.back() != 'a';
}

VesselKind kindOfShortForm(std::string_view raw, std::string_view words) {
  const std::string_view form = shortForm(raw, words);
  if (form == "a" || form == "aa") return VesselKind::artery;
  return form == "v" || form == "vv" ? VesselKind::vein : VesselKind::other;
}

// What has no Latin letters, and is no word of nameWords(): Chinese, Japanese, Korean, Russian.
bool says(std::string_view raw, std::initializer_list<std::string_view> signs) {
  return std::ranges::any_of(signs, [&](std::string_view sign) { return raw.find(sign) != raw.npos; });
}
bool saysArtery(std::string_view raw) {
  return says(raw, {"動脈", "动脉", "動静脈", "动静脉", "動靜脈", "동맥", "동정맥", "ртери", "аорт", "Аорт",
                    "АРТЕРИ", "АОРТ", "腹腔干", "头臂干", "ревный ствол", "еголовной ствол", "очный ствол"});
}
bool saysPortal(std::string_view raw) {
  return says(raw, {"門脈", "門静脈", "门静脉", "門靜脈", "문맥", "воротная", "воротной", "Воротная"});
}
bool saysVein(std::string_view raw) {
  return saysPortal(raw) || says(raw, {"静脈", "静脉", "靜脈", "정맥", "вена", "Вена", "вены", "Вены", "ВЕНА",
                                       "ВЕНЫ", "ВЕНОЗ", "веноз"});
}

// With what follows the side in initials: LICA, RMCA, LSVC.
std::string withInitials(std::string_view raw) {
  const std::string words = spaced(raw);
  std::string all = words;
  for (std::size_t at = 1, end; (end = words.find(' ', at)) != words.npos; at = end + 1)
    if (end - at == 4 && (words[at] == 'l' || words[at] == 'r')) all += words.substr(at + 1, 4);
  return all;
}

// A text that says both ("artery beside a vein", "arteriovenous") says neither, and is left to the next
// source.
VesselKind kindInWords(std::string_view raw, const std::string& text) {
  // Arches and arcades of hand, foot and bowel are arteries where nothing says that they are venous.
  static constexpr std::array<std::string_view, 70> kArtery{"arter",
                                                            "artar",
                                                            "schlagader",
                                                            "slagader",
                                                            "aorta",
                                                            "aorte",
                                                            "aortic",
                                                            "coeliac trunk",
                                                            "celiac trunk",
                                                            "truncus coeliacus",
                                                            "pulmonary trunk",
                                                            "truncus pulmonalis",
                                                            "brachiocephalic trunk",
                                                            "carotid",
                                                            "carotis",
                                                            " lad ",
                                                            " rca ",
                                                            " lcx ",
                                                            "thyrocervical",
                                                            "thyreocervical",
                                                            "tronco celiaco",
                                                            "tronc coeliaque",
                                                            "tronco pulmonar",
                                                            "tronc pulmonaire",
                                                            "tronco polmonare",
                                                            " cca ",
                                                            " ica ",
                                                            " eca ",
                                                            " mca ",
                                                            " aca ",
                                                            " pca ",
                                                            " acom ",
                                                            " pcom ",
                                                            " sma ",
                                                            " cfa ",
                                                            " sfa ",
                                                            "costocervical",
                                                            "palmar arch",
                                                            "plantar arch",
                                                            "carpal arch",
                                                            "intestinal arcade",
                                                            "truncus brachioc",
                                                            "tr coeliacus",
                                                            "tr brachioc",
                                                            "tr pulm",
                                                            "tronc celiaque",
                                                            "tronc brachio",
                                                            "tronco braquio",
                                                            "tronco brachio",
                                                            "ramus interventricularis",
                                                            "r interventricularis",
                                                            "ramus circumflexus",
                                                            "r circumflexus",
                                                            " rcx ",
                                                            " riva ",
                                                            " a com ",
                                                            " p com ",
                                                            " a co a ",
                                                            " p co a ",
                                                            " acoa ",
                                                            " pcoa ",
                                                            " pica ",
                                                            " aica ",
                                                            " eia ",
                                                            " iia ",
                                                            " cia ",
                                                            " pda ",
                                                            " ima ",
                                                            " lpa ",
                                                            " rpa "};
  static constexpr std::array<std::string_view, 53> kVein{" vein",
                                                          " vena ",
                                                          " venas ",
                                                          " venae ",
                                                          "vene ",
                                                          "venen ",
                                                          " veia",
                                                          " ader ",
                                                          " aders ",
                                                          "venous",
                                                          "venule",
                                                          "azygos",
                                                          "azygous",
                                                          " cava ",
                                                          " svc ",
                                                          " ivc ",
                                                          " smv ",
                                                          " ijv ",
                                                          " cfv ",
                                                          "dural sinus",
                                                          "seno coronario",
                                                          "coronary sinus",
                                                          "sagittal sinus",
                                                          "transverse sinus",
                                                          "sigmoid sinus",
                                                          "sinus coronarius",
                                                          "sinus transversus",
                                                          "sinus sigmoideus",
                                                          "sinus rectus",
                                                          "sinus cavernosus",
                                                          "sinus durae",
                                                          "jugular",
                                                          "straight sinus",
                                                          "occipital sinus",
                                                          "cavernous sinus",
                                                          "petrosal sinus",
                                                          "confluence of sinuses",
                                                          "pterygoid plexus",
                                                          "pampiniform",
                                                          "pfortader",
                                                          "venos",
                                                          "sinus sagittal",
                                                          "sinus longitudinal",
                                                          "sinus droit",
                                                          "seno sagit",
                                                          "seno retto",
                                                          "seno recto",
                                                          "seno transverso",
                                                          "seno trasverso",
                                                          " imv ",
                                                          " sss ",
                                                          " gsv ",
                                                          " ssv "};
  static constexpr std::array<std::string_view, 2> kLymph{"lymph", "thoracic duct"};
  const bool artery = hasAny(text, kArtery) || saysArtery(raw), vein = hasAny(text, kVein) || saysVein(raw);
  if (hasAny(text, kLymph) || says(raw, {"リンパ", "淋巴", "림프", "лимф"})) return VesselKind::lymphatic;
  if (artery == vein) return artery ? VesselKind::other : kindOfShortForm(raw, text);
  return artery ? VesselKind::artery : VesselKind::vein;
}

// What a vessel runs beside or leaves tells its kind where nothing else does: "V. comitans arteriae
// brachialis" is a vein, "Ramus arteriae femoralis" an artery.
VesselKind kindInText(std::string_view raw) {
  const std::string text = withInitials(raw);
  std::string own = text;
  for (const std::string_view of : {" arteriae ", " venae "})
    if (const std::size_t at = own.find(of, 1); at != own.npos && !own.substr(0, at).ends_with(" et"))
      own.erase(at, of.size() - 1);
  if (own.size() < text.size())
    if (const VesselKind kind = kindInWords(raw, own); kind != VesselKind::other) return kind;
  return kindInWords(raw, text);
}

// The great vessels, whose names do not say it in every language.
struct Known {
  std::string_view ontology, number;
  VesselKind kind;
};
constexpr std::array kKnown{
    Known{"fma", "3734", VesselKind::artery},   // aorta
    Known{"fma", "3736", VesselKind::artery},   // ascending aorta
    Known{"fma", "3768", VesselKind::artery},   // arch of aorta
    Known{"fma", "3784", VesselKind::artery},   // descending aorta
    Known{"fma", "87217", VesselKind::artery},  // descending thoracic aorta
    Known{"fma", "3789", VesselKind::artery},   // abdominal aorta
    Known{"fma", "3932", VesselKind::artery},   // brachiocephalic artery
    Known{"fma", "8612", VesselKind::artery},   // pulmonary trunk
    Known{"fma", "50873", VesselKind::artery},  // left pulmonary artery
    Known{"fma", "50872", VesselKind::artery},  // right pulmonary artery
    Known{"fma", "4720", VesselKind::vein},     // superior vena cava
    Known{"fma", "10951", VesselKind::vein},    // inferior vena cava
    Known{"fma", "4706", VesselKind::vein},     // coronary sinus
    Known{"fma", "50735", VesselKind::portalVein},  Known{"uberon", "0000947", VesselKind::artery},  // aorta
    Known{"uberon", "0002333", VesselKind::artery},  // pulmonary trunk
    Known{"uberon", "0001585", VesselKind::vein},    // superior vena cava
    Known{"uberon", "0001072", VesselKind::vein},    // inferior vena cava
    Known{"uberon", "0005438", VesselKind::vein},    // coronary sinus
};

VesselKind kindByNumber(std::string_view raw) {
  const std::string text = spaced(raw);
  for (const Known& known : kKnown)
    if (text.find(' ' + std::string(known.ontology) + ' ' + std::string(known.number) + ' ') != text.npos)
      return known.kind;
  return VesselKind::other;
}

// Of a vein's names.
bool namesPortal(std::string_view text) {
  static constexpr std::array<std::string_view, 5> kPortal{" portal ", " portae ", "pfortader", " porta ",
                                                           " porte "};
  return hasAny(spaced(text), kPortal) || saysPortal(text);
}

// Red and blue as every atlas has them, if it has; pink organs and grey plaster say nothing.
VesselKind kindOfColour(vec3 c) {
  constexpr float kClearly = 2;  // times as much as of either other colour
  if (c.r > 0.05f && c.r > kClearly * std::max(c.g, c.b)) return VesselKind::artery;
  if (c.b > 0.05f && c.b > kClearly * c.r && c.b > 1.25f * c.g) return VesselKind::vein;
  return VesselKind::other;
}

}  // namespace

VesselKind kindOf(const MeshMaterial& material) {
  const VesselKind kind = kindInText(material.name);
  if (kind == VesselKind::vein && namesPortal(material.name)) return VesselKind::portalVein;
  return kind == VesselKind::other && material.colour ? kindOfColour(*material.colour) : kind;
}

VesselKind kindOfTexts(const MeshElement& element, std::string_view fileName) {
  MeshElement bare{element.name, element.category, element.ontologyId, {}};
  for (const std::string& text : element.surroundings)
    if (std::ranges::find(element.materials, text, &MeshMaterial::name) == element.materials.end())
      bare.surroundings.push_back(text);
  return kindOf(bare, fileName);
}

VesselKind kindOf(const MeshElement& element, std::string_view fileName) {
  std::vector<std::string_view> numbered{element.ontologyId, element.name},
      texts{element.category, element.name, fileName};
  for (const std::string& name : element.surroundings) numbered.push_back(name), texts.push_back(name);
  VesselKind kind = kindInText(element.category);
  for (const std::string_view text : numbered)
    if (kind == VesselKind::other) kind = kindByNumber(text);
  for (const std::string_view text : texts)
    if (kind == VesselKind::other) kind = kindInText(text);
  if (kind == VesselKind::other && element.colour) kind = kindOfColour(*element.colour);
  if (kind != VesselKind::vein) return kind;
  const bool told = namesPortal(element.category) || namesPortal(element.name) ||
                    std::ranges::any_of(element.surroundings, namesPortal);
  return told ? VesselKind::portalVein : kind;
}

bool namesNoVessel(const MeshElement& element, std::string_view fileName) {
  // What segmentations of whole bodies name: organs, bones, muscles, and what is found or put in vessels;
  // then the first of these in Latin, German, French, Spanish, Portuguese and Italian. Whole words where
  // vessels are called after them: vertebral, bronchial, ovarian, cystic, inferior thyroid.
  static constexpr std::array<std::string_view, 151> kOther{
      " kidney ",     " kidneys ",     " liver ",     " spleen ",     " stomach ",
      " pancreas ",   " gallbladder ", " gall ",      " bladder ",    " esophagus ",
      " oesophagus ", " trachea ",     " bronchus ",  " bronchi ",    " thyroid gland ",
      " bowel ",      " duodenum ",    " colon ",     " intestine ",  " intestines ",
      " rectum ",     " prostate ",    " uterus ",    " ovary ",      " ovaries ",
      " testis ",     " brain ",       " cerebrum ",  " cerebellum ", " brainstem ",
      " heart ",      " atrium ",      " ventricle ", " myocardium ", " lung ",
      " lungs ",      " pleura ",      " diaphragm ", " muscle",      " gluteus ",
      " iliopsoas ",  " autochthon ",  " skin ",      " fat ",        " bone",
      " skull ",      " vertebra ",    " vertebrae ", " rib ",        " ribs ",
      " sternum ",    " sacrum ",      " femur ",     " tibia ",      " fibula ",
      " humerus ",    " ulna ",        " scapula ",   " clavicle ",   " clavicula ",
      " pelvis ",     " hip ",         " cartilage",  " tooth ",      " teeth ",
      " disc ",       " spinal cord ", " nerve",      " eye ",        " eyes ",
      " tumor",       " tumour",       " cyst ",      " cysts ",      " lesion",
      " calcif",      " thromb",       " stent ",     " catheter ",   " adrenal gland ",
      " hepar ",      " renes ",       " lien ",      " pulmo ",      " pulmones ",
      " gaster ",     " ventriculus ", " vesica ",    " encephalon ", " costa ",
      " costae ",     " os ",          " ossa ",      " cranium ",    " musculus ",
      " musculi ",    " nervus ",      " nervi ",     " glandula ",   " ligamentum ",
      " cutis ",      " leber ",       " niere ",     " nieren ",     " milz ",
      " herz ",       " lunge ",       " lungen ",    " knochen ",    " gehirn ",
      " magen ",      " darm ",        " muskel ",    " rippe ",      " wirbel ",
      " schadel ",    " becken ",      " foie ",      " rein ",       " reins ",
      " ceur ",       " coeur ",       " poumon ",    " poumons ",    " cerveau ",
      " estomac ",    " peau ",        " higado ",    " rinon ",      " rinones ",
      " bazo ",       " corazon ",     " pulmon ",    " hueso ",      " huesos ",
      " cerebro ",    " piel ",        " figado ",    " coracao ",    " pulmao ",
      " osso ",       " fegato ",      " rene ",      " reni ",       " milza ",
      " cuore ",      " polmone ",     " polmoni ",   " cervello ",   " ureter ",
      " ureters "};
  // "Liver vessels", "branch to the stomach", "heart coronaries", "Herzkranzgefäße".
  static constexpr std::array kVessel = std::to_array<std::string_view>(
      {" vessel",   " vasc",    " branch",  " trunk ",   " plexus",     " sinus",     " anast",
       " perfor",   " arcade",  " lumen",   " capillar", " circumflex", " marginal ", "gefa",
       " vaisseau", " vaso ",   " vasos ",  " vasi ",    " vas ",       " vasa ",     " coronar",
       " coronair", " koronar", " willis ", " basilar ", " sylvi",      " portal ",   " porta ",
       " aneurysm", " fistul",  " graft",   " bypass",   " shunt",      " tips ",     " varic"});
  const std::string text = spaced(element.name);
  const bool first = text.starts_with(" a ") || text.starts_with(" v ");  // "A lien", without its dot
  const bool other =
      hasAny(text, kOther) || text.starts_with(" ren dext") || text.starts_with(" ren sinist") ||
      isMuscleOrNerve(element.name, text) ||
      says(element.name,
           {"肝",        "腎",        "肾",     "脾",     "心臓",   "心脏",  "肺",        "骨",
            "심장",      "신장",      "печень", "почка",  "Печень", "Почка", "селезенка", "селезёнка",
            "Селезенка", "Селезёнка", "сердце", "Сердце", "кость",  "Кость"});
  const bool vessel = first || hasAny(text, kVessel) ||
                      says(element.name, {"血管", "脉", "脈", "혈관", "сосуд", "腸骨", "肠骨", "髂"});
  // By all texts and no colour: organs have some, too.
  const MeshElement told{element.name, element.category, element.ontologyId, {}, element.surroundings};
  return other && !vessel && kindOf(told, fileName) == VesselKind::other;
}

}  // namespace vasa
