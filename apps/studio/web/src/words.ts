// Texts of the page: English is the key, German beside it.
const german: Record<string, string> = {
  'Undo': 'Zurück', 'Redo': 'Wieder', 'Select': 'Wählen', 'Pull': 'Ziehen', 'Open': 'Öffnen', 'Flip': 'Wenden',
  'Symmetric': 'Symmetrisch', 'Symmetry': 'Symmetrie', 'No symmetry': 'Keine Symmetrie', 'Mirror left and right': 'Links und rechts spiegeln',
  'Mirror front and back': 'Vorn und hinten spiegeln', 'Axis': 'Achse', 'Fit': 'Alles zeigen', 'Help': 'Hilfe',
  'Fabricate': 'Fertigen', 'Library': 'Formen', 'History': 'Verlauf', 'Parts': 'Teile', 'Language': 'Sprache',
  'Dark or light': 'Dunkel oder hell', 'Colours': 'Farben', 'Sides': 'Seiten', 'Defect': 'Defekt', 'Strain': 'Dehnung',
  'Components': 'Bestandteile', 'elements': 'Elemente', 'sheets': 'Bögen', 'min': 'min', 'Join': 'Verbinden',
  'Keep apart': 'Getrennt lassen', 'way': 'Art', 'ways': 'Arten', 'of': 'von', 'Close': 'Schließen', 'Delete': 'Löschen',
  'Change': 'Ändern', 'Apply': 'Übernehmen', 'Cancel': 'Abbrechen', 'New': 'Neu', 'Open file': 'Datei öffnen',
  'Save a copy': 'Kopie sichern', 'saved': 'gesichert', 'Layout': 'Zeichnen', 'New layout': 'Neue Zeichnung',
  'Sheets': 'Bögen', 'Booklet': 'Heft', 'Player': 'Film', 'Files': 'Dateien', 'Download kit': 'Bausatz herunterladen',
  'Make the kit': 'Bausatz machen', 'Material': 'Material', 'Machine': 'Maschine', 'Paper': 'Papier', 'by thickness': 'nach Dicke',
  'none in particular': 'keine bestimmte', 'Making': 'In Arbeit', 'pieces': 'Teile', 'to cut': 'zu schneiden', 'to build': 'zu bauen',
  'Drag a shape into the scene': 'Eine Form in die Szene ziehen',
  'Click a shape in the library, or drag it into this view, to begin.': 'Zum Beginnen eine Form in der Sammlung anklicken oder in diese Ansicht ziehen.',
  'Click chooses, drag moves the chosen part, drag beside it turns the view.': 'Klicken wählt, Ziehen bewegt das gewählte Teil, Ziehen daneben dreht die Ansicht.',
  'Press on a vertex and pull: the limb grows. Choose the brush in the library.': 'Auf eine Ecke drücken und ziehen: das Glied wächst. Den Pinsel in den Formen wählen.',
  'Click elements to take out, then choose what for.': 'Elemente anklicken, die herausgenommen werden, dann den Zweck wählen.',
  'Click an element to turn it over.': 'Ein Element anklicken, um es zu wenden.',
  'Take out': 'Herausnehmen', 'lamp holder': 'Fassung', 'bulb hatch': 'Luke', 'cable': 'Kabel', 'Purpose': 'Zweck',
  'settling': 'setzt sich', 'working': 'rechnet', 'grown': 'gewachsen', 'Suggest': 'Vorschlag', 'Do it': 'So machen',
  'Looking for a pose that works': 'Suche eine Lage, die passt', 'No pose nearby works': 'Keine Lage in der Nähe passt',
  'move closer by': 'näher heran um', 'move apart by': 'auseinander um', 'move aside by': 'zur Seite um', 'turn by': 'drehen um',
  'The document was changed elsewhere; you see the newest version now. Undo brings back the one before.':
    'Das Dokument wurde anderswo geändert; dies ist die neueste Fassung. Zurück holt die vorige wieder.',
  'The studio does not answer. Start it again: everything up to the last step is saved.': 'Das Studio antwortet nicht. Bitte neu starten: alles bis zum letzten Schritt ist gesichert.',
  'This address belongs to an earlier run of the studio. Open the address that it printed.': 'Diese Adresse gehört zu einem früheren Lauf. Bitte die neu ausgegebene Adresse öffnen.',
  'Untitled': 'Ohne Titel', 'Title': 'Titel', 'Move': 'Bewegen', 'Turn': 'Drehen', 'Handles': 'Griffe', 'Shape': 'Form', 'Brush': 'Pinsel',
  'Position (mm)': 'Ort (mm)', 'Rotation (degrees)': 'Drehung (Grad)', 'Pull by (mm)': 'Ziehen um (mm)', 'Candidate': 'Auswahl',
  'Remove this step': 'Diesen Schritt entfernen', 'Change this step': 'Diesen Schritt ändern', 'element': 'Element', 'vertex': 'Ecke',
  'front': 'vorn', 'flipped': 'gewendet', 'valence': 'Valenz', 'defect': 'Defekt', 'strain': 'Dehnung', 'opening': 'Öffnung',
  'compressed': 'gestaucht', 'stretched': 'gedehnt', 'saddle': 'Sattel', 'peak': 'Spitze', 'flat': 'flach',
  'Add element': 'Element dazu', 'Place in the scene': 'In die Szene setzen', 'Drag elements; drag from side to side to connect; R turns, F flips, Delete removes.':
    'Elemente ziehen; von Seite zu Seite ziehen verbindet; R dreht, F wendet, Entf löscht.',
  'Other shape': 'Andere Form', 'Place': 'Setze', 'to': 'an', 'by': 'um', 'Mesh': 'Netz', 'Import a mesh': 'Netz einlesen', 'How many elements': 'Wie viele Elemente',
  'Choose elements of one part.': 'Bitte Elemente eines Teils wählen.', 'Keyboard': 'Tastatur', 'Everything fits the screen': 'Alles ins Bild', 'Front, side, top': 'Vorn, Seite, oben', 'Next and previous way to join': 'Nächste und vorige Verbindung',
  'Turn the view': 'Ansicht drehen', 'drag, two fingers, arrow keys': 'ziehen, Pfeiltasten', 'Shift the view': 'Ansicht schieben', 'right drag, two fingers': 'rechts ziehen, zwei Finger',
  'Zoom': 'Vergrößern', 'wheel, pinch, + and -': 'Rad, zwei Finger, + und -', 'Leave': 'Verlassen', 'Save to the library': 'In die Sammlung', 'My layouts': 'Meine Zeichnungen',
  'replay': 'Nachbauen', 'assembly plan': 'Bauplan', 'nesting and cut sheets': 'Bögen', 'booklet': 'Heft', 'preview': 'Vorschau',
  'The design has changed since this kit was made.': 'Der Entwurf hat sich seit diesem Bausatz geändert.',
  'Element': 'Element', 'Change the element': 'Element ändern', 'thick': 'dick', 'Short side (mm)': 'Kurze Seite (mm)', 'Long side (mm)': 'Lange Seite (mm)',
  'Acute angle (degrees)': 'Spitzer Winkel (Grad)', 'Thickness (mm)': 'Dicke (mm)', 'The whole design grows or shrinks with the short side': 'Der ganze Entwurf wächst oder schrumpft mit der kurzen Seite',
  'larger than 8 MB. Simplify the mesh first, or use rhombloom import in a terminal.': 'größer als 8 MB. Bitte das Netz erst vereinfachen oder rhombloom import in einem Terminal verwenden.',
  'Looking for a network of elements near the mesh. This may take a minute.': 'Sucht ein Netz von Elementen nahe der Form. Das kann eine Minute dauern.',
  'Way': 'Art', 'this is no design file.': 'das ist keine Entwurfsdatei.', 'deleted. Undo brings it back.': 'gelöscht. Zurück holt es wieder.',
  'Another design is open now. Undo brings the one before it back.': 'Jetzt ist ein anderer Entwurf offen. Zurück holt den vorigen wieder.',
  'Makes the sheets to cut, the booklet that shows every step, a film of the assembly and everything else as one file to download.':
    'Macht die Bögen zum Schneiden, das Heft mit jedem Schritt, einen Film vom Zusammenbau und alles Übrige als eine Datei zum Herunterladen.',
  'First steps': 'Erste Schritte', 'Click a shape in the library, or drag it into the view.': 'Eine Form in der Sammlung anklicken oder in die Ansicht ziehen.',
  'Drag a second shape so that it reaches into the first, step through the ways to join them, and join.': 'Eine zweite Form so ziehen, dass sie in die erste reicht, die Arten der Verbindung durchsehen, verbinden.',
  'Choose Pull, press on a vertex and drag: a limb grows.': 'Ziehen wählen, auf eine Ecke drücken und ziehen: ein Glied wächst.',
  'Open makes room for the lamp holder, the cable and the bulb.': 'Öffnen macht Platz für Fassung, Kabel und Leuchtmittel.',
  'Fabricate makes the kit. Everything is saved as you go; every step can be undone or changed in the history.': 'Fertigen macht den Bausatz. Alles wird laufend gesichert; jeder Schritt lässt sich zurücknehmen oder im Verlauf ändern.',
  'Along the normal': 'Entlang der Normalen', 'hold Shift while pulling': 'Umschalt beim Ziehen halten', 'Delete the chosen part': 'Gewähltes Teil löschen',
};

export type Language = 'en' | 'de';
export let language: Language = navigator.language.startsWith('de') ? 'de' : 'en';

export function setLanguage(next: Language): void {
  language = next;
  document.documentElement.lang = next;
}

export function t(text: string): string {
  return language === 'de' ? german[text] || text : text;
}

export function number(value: number, decimals = 0): string {
  return value.toLocaleString(language, { maximumFractionDigits: decimals, minimumFractionDigits: decimals });
}
