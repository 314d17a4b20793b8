// The program's reasons for refusing something, in German. What is not listed stays as it came.
import { language } from './words';


// $1, $2 ...: the numbers and names in the sentence; * stands for another reason within it.
const german: [RegExp, string][] = [
  [/^step (\d+) \(.*?\): (.+)$/, 'Schritt $1: *2'],
  [/^no way to join (\S+) at vertex (\d+) can be built: (.+)$/, '$1 lässt sich an Ecke $2 nicht ansetzen: *3'],
  [/^element (\d+) cannot be flipped: (.+)$/, 'Element $1 lässt sich nicht wenden: *2'],
  [/^one part lies inside the other/, 'Ein Teil liegt im anderen: so verschieben, dass sie sich schneiden.'],
  [/^the parts do not touch/, 'Die Teile berühren sich nicht: näher zusammenschieben, bis sie sich schneiden.'],
  [/^every element of both parts touches/, 'Jedes Element beider Teile berührt das andere Teil: etwas auseinanderschieben.'],
  [/^no closed loop of edges divides/, 'Nahe am Schnitt trennt kein geschlossener Kantenzug eines der Teile: so verschieben, dass sie sich gleichmäßiger schneiden.'],
  [/^none of (\d+) x (\d+) pairs of loops near the intersection keeps/, 'Keine der $1 × $2 Schnittlinien hält die zulässigen Defekte ein: ein Teil drehen oder verschieben.'],
  [/^none of (\d+) x (\d+) pairs of loops near the intersection joins/, 'Keine der $1 × $2 Schnittlinien ergibt eine Form, die sich bauen lässt: ein Teil drehen oder verschieben.'],
  [/^there is no further way to join/, 'Hier gibt es keine weitere Art der Verbindung.'],
  [/^there is no candidate (\d+): choose one from 0 to (\d+)/, 'Die Auswahl $1 gibt es nicht: möglich ist 0 bis $2.'],
  [/^there is no candidate (\d+)/, 'Die Auswahl $1 gibt es nicht: es gibt nur die Auswahl 0.'],
  [/^vertex (\d+) is touched by two separate fans/, 'An Ecke $1 hingen zwei Teile, die kein Haken hält: auch ein Nachbarelement öffnen oder andere.'],
  [/^\$\.(\S+) has the character (U\+\w+), which the booklet cannot write/, 'Der Name ($1) enthält das Zeichen $2, das die Anleitung nicht schreiben kann: lateinische, griechische oder kyrillische Buchstaben verwenden.'],
  [/^a merge needs two different parts|cannot be merged with itself$/, 'Verbinden lassen sich nur zwei verschiedene Teile.'],
  [/lies on an opening: choose an apex inside the surface$/, 'Die Ecke liegt an einer Öffnung: eine Ecke inmitten der Form wählen.'],
  [/^no loop round .+ can take (\S+) and gain elements/, '$1 passt hier nicht an: einen größeren Pinsel oder eine andere Ecke wählen.'],
  [/^none of the (\d+) pairs of loops of (\S+) and .+ keeps the permissible defects/, '$2 lässt sich hier nicht mit zulässigen Defekten ansetzen: einen anderen Pinsel oder eine andere Ecke wählen.'],
  [/^the drag is shorter than/, 'Der Zug ist kürzer als ein Tausendstel eines Elements.'],
  [/^the pull is (\d+) mm long: the studio takes up to (\d+) mm/, 'Der Zug ist $1 mm lang: das Studio nimmt bis zu $2 mm auf einmal.'],
  [/^(\S+) is too large to be pulled/, '$1 ist zum Ziehen zu groß: einen Pinsel mit höchstens 1000 Elementen wählen.'],
  [/^(\S+) has (\d+) elements: the studio takes shapes of up to (\d+)/, '$1 hat $2 Elemente: das Studio nimmt Formen mit bis zu $3.'],
  [/^nothing is left of the surface/, 'Von der Form bliebe nichts übrig.'],
  [/^without these elements the surface falls into two parts/, 'Ohne diese Elemente zerfällt die Form in zwei Teile: weniger oder andere öffnen.'],
  [/^there is no part "(.*?)"/, 'Ein Teil „$1“ gibt es an dieser Stelle des Verlaufs nicht.'],
  [/^there is already a part "(.*?)"/, 'Ein Teil „$1“ gibt es schon.'],
  [/^"(.*?)" is merged: change its step/, '„$1“ ist schon verbunden: bitte seinen Schritt im Verlauf ändern.'],
  [/^the operation is marked symmetric|^the design declares no symmetry/, 'Der Entwurf hat keine Symmetrie.'],
  [/^the surface is not symmetric here/, 'Die Form ist hier nicht symmetrisch: „Symmetrisch“ ausschalten oder die Stelle erst symmetrisch bauen.'],
  [/^the images of the symmetric operation overlap/, 'Die Spiegelbilder überschneiden sich: weiter weg von der Ebene oder Achse ansetzen.'],
  [/^there is no (element|vertex) (\d+): the part has (\d+)/, 'Nummer $2 gibt es nicht: das Teil hat $3, ab 0 gezählt.'],
  [/^side (\d) of element (\d+) is joined twice/, 'Seite $1 von Element $2 ist zweimal verbunden.'],
  [/^side (\d) of element (\d+) and side (\d) of element (\d+) are both/, 'Seite $1 von Element $2 und Seite $3 von Element $4 sind gleich lang: eine lange Seite gehört zu einer kurzen.'],
  [/^vertex (\d+) joins (\d+) elements with an angular defect of ([-\d.]+) degrees; permissible are ([-\d.]+) to ([-\d.]+)/,
    'In Ecke $1 treffen sich $2 Elemente mit einem Defekt von $3°; zulässig sind $4° bis $5°: dort ein Element wenden oder öffnen.'],
  [/^the surface falls into (\d+) unconnected parts/, 'Die Form zerfällt in $1 Teile: verbinden oder getrennt entwerfen.'],
  [/^an element would have to stretch by ([\d.]+) %, possible is ([\d.]+) %/, 'Ein Element müsste sich um $1 % dehnen, möglich sind $2 %: das engste Glied oder die engste Verbindung weiter machen.'],
  [/^unknown shape "(.*?)"/, 'Die Form „$1“ ist nicht bekannt; zum Beispiel gibt es ball-30 und polar-5x4.'],
  [/^there is nothing to (undo|do again)/, 'Da ist nichts mehr.'],
  [/^a kit is being made already/, 'Ein Bausatz wird schon gemacht.'],
  [/^cannot write (.+): the step was not taken/, '$1 – lässt sich nicht schreiben: Der Schritt wurde nicht getan. Bitte beheben und noch einmal versuchen, oder eine Kopie sichern.'],
  [/^(\S+) was changed by another program and cannot be used/, '$1 wurde von einem anderen Programm geändert und ist nicht zu gebrauchen: es wurde nichts geschrieben. Zum Weiterarbeiten die Datei beiseitelegen.'],
  [/^the document has changed in the meantime/, 'Das Dokument wurde inzwischen geändert.'],
];

export function reason(text: string): string {
  if (language !== 'de') return text;
  const bare = text.replace(/^\$[\w.[\]]*: /, '');
  for (const [english, words] of german) {
    const found = english.exec(bare);
    if (found) return words.replace(/\*(\d)/g, (_, k) => reason(found[Number(k)])).replace(/\$(\d)/g, (_, k) => found[Number(k)]);
  }
  return text;
}
