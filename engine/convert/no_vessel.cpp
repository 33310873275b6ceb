#include "convert/no_vessel.h"

#include <algorithm>
#include <array>

#include "convert/name_text.h"
#include "convert/source.h"
#include "core/name_words.h"

// The one place that says which names are those of no vessels: what segmentations of whole bodies name, and
// what is found or put in vessels.
namespace vasa {
namespace {

struct Names {
  NoVessel what;
  std::string_view language, names;  // as saysAny() has them
};

// What carries no blood and lies in what does: a vessel's name beside it says where.
constexpr std::array kInVessels{
    Names{NoVessel::device, "English",
          "stent, stents, stentgraft, catheter, catheters, guidewire, guide wire, pacemaker, electrode, "
          "coil, coils, clip, clips, prosthesis, cava filter, ivc filter"},
    Names{
        NoVessel::device, "others",
        "katheter, elektrode, herzschrittmacher, endoprothese, endoprotesis, cateter, catetere, 支架, ステント, "
        "스텐트, стент, Стент"},
    Names{
        NoVessel::finding, "English",
        "thrombus, thrombi, thrombosis, clot, clots, embolus, emboli, embolism*, calcification, calcifications, "
        "calc, plaque, plaques, hematoma, haematoma, hemorrhage, haemorrhage, effusion"},
    Names{
        NoVessel::finding, "others",
        "gerinnsel, *verkalkung*, calcificacion, calcificaciones, calcificacao, calcificacoes, "
        "calcificazione, calcificazioni, trombo, trombi, caillot, 血栓, 钙化, 鈣化, 石灰化, 혈전, тромб, Тромб"},
    Names{NoVessel::organ, "English, Latin, German",
          "lymph node, lymph nodes, lymphnode*, nodi lymphoidei, nodi lymphatici, nodus lymphoideus, "
          "nodus lymphaticus, lymphknoten"},
    Names{NoVessel::organ, "Chinese, Japanese, Korean", "淋巴结, 淋巴結, リンパ節, 림프절"},
    Names{NoVessel::heart, "English", "valve, valves, leaflet, leaflets"},
    Names{NoVessel::heart, "others",
          "*klappe, *klappen, valvula, valvulae, valvola, valvole, клапан, Клапан, 瓣, 動脈弁, 僧帽弁, "
          "三尖弁, 판막, 동맥판, 승모판, 삼첨판"},
};
// But what follows one of these: "aorta with thrombus", "aorta post stent", "LAD distal to stent" are vessels
// that have one.
constexpr std::string_view kHaving =
    "with, without, after, before, pre, no, in, to, from, of, at, near, above, below, and, incl, including, "
    "excluding, minus, mit, ohne, nach, vor, inkl, avec, sans, apres, avant, con, sem, senza";
// Likewise, but where they are abbreviations: "A. coronaria sin. Stent", "A. carotis com. Plaque".
constexpr std::string_view kHavingOrShort = "post, sin, com", kCommunicating = "a com, p com";

// What has vessels that are called after it: "liver vessels", "kidney_RA". Whole words where a vessel's
// adjective begins like it: vertebral, bronchial, ovarian, cystic, inferior thyroid.
constexpr std::array kInBodies{
    Names{NoVessel::organ, "English",
          "kidney, kidneys, liver, spleen, stomach, pancreas, gallbladder, gall, bladder, esophagus, "
          "oesophagus, trachea, windpipe, bronchus, bronchi, larynx, pharynx, tongue, thymus, gland, glands, "
          "bowel, duodenum, jejunum, ileum, cecum, caecum, colon, intestine, intestines, rectum, prostate, "
          "uterus, ovary, ovaries, testis, brain, cerebrum, cerebellum, brainstem, spinal cord, lung, lungs, "
          "diaphragm, eye, eyes, ureter, ureters, airway, airways, organ, organs, hypopharynx, nasal cavity, "
          "auditory canal, palate, lobe, lobes, renal pyramid"},
    Names{NoVessel::organ, "Latin",
          "hepar, ren dext*, ren sinist*, renes, lien, pulmo, pulmones, gaster, ventriculus, vesica, "
          "encephalon, glandula"},
    Names{NoVessel::organ, "German",
          "leber, niere, nieren, milz, lunge, lungen, gehirn, magen, darm, blase, gallenblase, harnblase, "
          "bauchspeicheldruse"},
    Names{NoVessel::organ, "French", "foie, rein, reins, poumon, poumons, cerveau, estomac"},
    Names{NoVessel::organ, "Spanish", "higado, rinon, rinones, bazo, pulmon, cerebro"},
    Names{NoVessel::organ, "Portuguese", "figado, pulmao"},
    Names{NoVessel::organ, "Italian", "fegato, rene, reni, milza, polmone, polmoni, cervello"},
    Names{NoVessel::organ, "Chinese, Japanese, Korean", "肝, 腎, 肾, 脾, 肺, 신장"},
    Names{NoVessel::organ, "Russian",
          "печень, почка, легк, лёгк, Печень, Почка, Легк, Лёгк, селезенка, селезёнка, Селезенка, Селезёнка"},
    Names{NoVessel::heart, "English", "heart, atrium, atrial appendage, ventricle, myocardium, septum"},
    Names{NoVessel::heart, "others",
          "herz, ceur, coeur, corazon, coracao, cuore, 心臓, 心脏, 심장, сердце, Сердце"},
    Names{
        NoVessel::bone, "English",
        "bone*, skeleton, spine, skull, vertebra, vertebrae, rib, ribs, sternum, sacrum, femur, tibia, fibula, humerus, "
        "ulna, radius, patella, mandible, maxilla, scapula, clavicle, pelvis, hip, cartilage*, tooth, teeth, disc, "
        "hyoid, zygomatic arch, styloid process, phalanx, phalanges, carpals, metacarpals, tarsals, metatarsals"},
    Names{NoVessel::bone, "Latin", "clavicula, costa, costae, os, ossa, cranium"},
    Names{NoVessel::bone, "German", "knochen, rippe, wirbel, schadel, becken"},
    Names{NoVessel::bone, "Spanish, Portuguese, Italian", "hueso, huesos, osso"},
    Names{NoVessel::bone, "Chinese, Japanese, Russian", "骨, кост, Кост"},
    Names{
        NoVessel::tissue, "English",
        "muscle*, gluteus, iliopsoas, autochthon, skin, fat, nerve*, pleura, sternocleidomastoid, trapezius, "
        "platysma, quadriceps, biceps, triceps, deltoid, sartorius, masseter, pectoralis, latissimus, supraspinatus, "
        "infraspinatus, subscapularis, levator, body trunc, body extremities, torso"},
    Names{NoVessel::tissue, "Latin", "musculus, musculi, nervus, nervi, ligamentum, cutis"},
    Names{NoVessel::tissue, "German, French, Spanish", "muskel, peau, piel"},
    Names{NoVessel::finding, "English", "tumor*, tumour*, cyst, cysts, lesion*, calcif*, thromb*"},
};

// What beside one of those names says that a vessel is meant.
constexpr std::string_view kVessel =
    "vessel*, vasc*, branch*, trunk, plexus*, sinus*, anast*, perfor*, arcade*, lumen*, capillar*, "
    "circumflex*, marginal, marginalis, profunda, nutrient, nutricia, *gefa*, vaisseau*, vaso, vasos, vasi, "
    "vas, vasa, coronar*, coronair*, koronar*, willis, basilar, sylvi*, portal, porta, aneurysm*, fistul*, "
    "graft*, bypass*, shunt*, tips, varic*, 血管, 脉, 脈, 혈관, сосуд, 腸骨, 肠骨, 髂";

// The same beside an organ or a bone alone: adjectives, and short forms, which beside a heart mean a chamber;
constexpr std::string_view kBesideOrgan =
    "hepatic, hepatica, renal, renalis, splenic, lienalis, gastric, gastrica, mesenteric, mesenterica, "
    "pulmonary, pulmonalis, cerebral, colic, colica, ileocolic, cystic, vesical, phrenic, ra, rv, lra, rra, "
    "lrv, rrv, ha, hv, lhv, mhv, rhv, pa, pv, sa, sv";
constexpr std::string_view kBesideBone =
    "tibia ant, tibia post, femoral, femoralis, tibial, tibialis, popliteal, poplitea, peroneal, fibularis, "
    "intercostal, intercostalis, genicular";
// but of a part: "colon splenic flexure", "renal pelvis of kidney", "femur femoral head".
constexpr std::string_view kParts =
    "lobe*, lobus, segment, segments, segmentum, flexure, cortex, medulla, pelvis, capsule, parenchyma, surface, gland, head, "
    "neck, shaft, condyle*, plateau, tuberosity, epiphysis, component, lappen, tumor*, "
    "tumour*, cyst, cysts, lesion*, nodule*, mass, duct*, stone*, fracture*, muscle*, nerve*, cartilage*, "
    "matter, column*, pyramid*, wall, stem, tray";

template <std::size_t N>
NoVessel foundIn(const NameText& name, const std::array<Names, N>& table) {
  const auto found = std::ranges::find_if(table, [&](const Names& own) { return saysAny(name, own.names); });
  return found == table.end() ? NoVessel::none : found->what;
}

// "M. biceps", "N. vagus", which are masculine; not of main, middle and new: "M. media", "N. coronaria", "M.
// sup".
bool isMuscleOrNerve(const NameText& name) {
  const std::string_view form = shortForm(name);
  if (form.empty() || name.raw[form.size()] != '.' ||
      (form != "m" && form != "mm" && form != "n" && form != "nn"))
    return false;
  const std::string_view rest = std::string_view(name.words).substr(form.size() + 2),
                         next = rest.substr(0, rest.find(' '));
  return next.size() > 3 && next.back() != 'a';
}

NoVessel lyingInVessel(NameText name) {
  const auto cutBehind = [&](std::string_view list) {
    for (const std::string& word : nameWords(list))
      if (const std::size_t at = name.words.find(' ' + word + ' '); at != name.words.npos)
        name.words.erase(at + 1);
  };
  cutBehind(kHaving);
  if (name.raw.find('.') == name.raw.npos && shortForm(name).empty() && !saysAny(name, kCommunicating))
    cutBehind(kHavingOrShort);
  return foundIn(name, kInVessels);
}

bool saysVessel(const NameText& name, NoVessel beside) {
  if (name.words.starts_with(" a ") || name.words.starts_with(" v ") || saysAny(name, kVessel)) return true;
  const std::string_view own = beside == NoVessel::organ  ? kBesideOrgan
                               : beside == NoVessel::bone ? kBesideBone
                                                          : "";
  return saysAny(name, own) && !saysAny(name, kParts);
}

}  // namespace

std::string_view reasonOf(NoVessel why) {
  switch (why) {
    case NoVessel::organ:
      return "organ";
    case NoVessel::heart:
      return "heart";
    case NoVessel::bone:
      return "bone";
    case NoVessel::tissue:
      return "tissue";
    case NoVessel::finding:
      return "finding";
    case NoVessel::device:
      return "device";
    case NoVessel::width:
      return "wider than a vessel";
    case NoVessel::outerWall:
      return "outside of a wall";
    case NoVessel::none:
      break;
  }
  return {};
}

NoVessel namesNoVessel(const MeshElement& element, std::string_view fileName) {
  const NameText name(element.name);
  if (const NoVessel within = lyingInVessel(name);
      within != NoVessel::none && kindOf(MeshElement{{}, element.category, {}, {}}, {}) == VesselKind::other)
    return within;
  const NoVessel what = isMuscleOrNerve(name) ? NoVessel::tissue : foundIn(name, kInBodies);
  if (what == NoVessel::none || saysVessel(name, what)) return NoVessel::none;
  // By all texts and no colour: organs have some, too.
  const MeshElement told{element.name, element.category, element.ontologyId, {}, element.surroundings};
  return kindOf(told, fileName) == VesselKind::other ? what : NoVessel::none;
}

}  // namespace vasa
