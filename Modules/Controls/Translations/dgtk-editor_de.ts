<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de_DE" sourcelanguage="en">
<context>
    <name>CameraText</name>
    <message>
        <source>Size: %1 x %2 pixels</source>
        <translation>Größe: %1 x %2 Pixel</translation>
    </message>
    <message>
        <source>Lens: %1</source>
        <translation>Linse: %1</translation>
    </message>
    <message>
        <source>Distortion: %1</source>
        <translation>Verzeichnung: %1</translation>
    </message>
    <message>
        <source>none</source>
        <translation>keine</translation>
    </message>
    <message>
        <source>Near, far: %1, %2</source>
        <translation>Nah, fern: %1, %2</translation>
    </message>
    <message>
        <source>K (pixels from camera axes)</source>
        <translation>K (Pixel aus Kameraachsen)</translation>
    </message>
    <message>
        <source>R (x_camera = R x_world + t)</source>
        <translation>R (x_Kamera = R x_Welt + t)</translation>
    </message>
    <message>
        <source>Layer calibration (axes of OpenGL, y up)</source>
        <translation>Ebene calibration (Achsen von OpenGL, y aufwärts)</translation>
    </message>
    <message>
        <source>%1, frame %2</source>
        <translation>%1, Bild %2</translation>
    </message>
    <message>
        <source>cameras.json does not have this camera at this frame.</source>
        <translation>cameras.json hat diese Kamera zu diesem Bild nicht.</translation>
    </message>
    <message>
        <source>Viewport</source>
        <translation>Bildbereich</translation>
    </message>
</context>
<context>
    <name>Contents</name>
    <message>
        <source>1 object</source>
        <translation>1 Objekt</translation>
    </message>
    <message>
        <source>%1 objects</source>
        <translation>%1 Objekte</translation>
    </message>
    <message>
        <source>1 light</source>
        <translation>1 Licht</translation>
    </message>
    <message>
        <source>%1 lights</source>
        <translation>%1 Lichter</translation>
    </message>
    <message>
        <source>1 camera</source>
        <translation>1 Kamera</translation>
    </message>
    <message>
        <source>%1 cameras</source>
        <translation>%1 Kameras</translation>
    </message>
</context>
<context>
    <name>Edit</name>
    <message>
        <source>Add camera</source>
        <translation>Kamera hinzufügen</translation>
    </message>
    <message>
        <source>Add camera array</source>
        <translation>Kamerafeld hinzufügen</translation>
    </message>
    <message>
        <source>Add light</source>
        <translation>Licht hinzufügen</translation>
    </message>
    <message>
        <source>Change frame rate</source>
        <translation>Bildrate ändern</translation>
    </message>
    <message>
        <source>Change the lens</source>
        <translation>Objektiv ändern</translation>
    </message>
    <message>
        <source>Set image size</source>
        <translation>Bildgröße setzen</translation>
    </message>
    <message>
        <source>Change interpolation</source>
        <translation>Interpolation ändern</translation>
    </message>
    <message>
        <source>Change interpolation of keys</source>
        <translation>Interpolation von Schlüsseln ändern</translation>
    </message>
    <message>
        <source>Change speed of sequence</source>
        <translation>Tempo der Sequenz ändern</translation>
    </message>
    <message>
        <source>Choose sequence</source>
        <translation>Sequenz wählen</translation>
    </message>
    <message>
        <source>Copy key frame</source>
        <translation>Schlüsselbild kopieren</translation>
    </message>
    <message>
        <source>Copy keys</source>
        <translation>Schlüssel kopieren</translation>
    </message>
    <message>
        <source>Cut</source>
        <translation>Ausschneiden</translation>
    </message>
    <message>
        <source>Delete</source>
        <translation>Löschen</translation>
    </message>
    <message>
        <source>Duplicate</source>
        <translation>Duplizieren</translation>
    </message>
    <message>
        <source>Find models</source>
        <translation>Modelle suchen</translation>
    </message>
    <message>
        <source>Import</source>
        <translation>Importieren</translation>
    </message>
    <message>
        <source>Make key frame</source>
        <translation>Schlüsselbild setzen</translation>
    </message>
    <message>
        <source>Move</source>
        <translation>Verschieben</translation>
    </message>
    <message>
        <source>Move key frame</source>
        <translation>Schlüsselbild verschieben</translation>
    </message>
    <message>
        <source>Move keys</source>
        <translation>Schlüssel verschieben</translation>
    </message>
    <message>
        <source>Move sequence</source>
        <translation>Sequenz verschieben</translation>
    </message>
    <message>
        <source>Paste</source>
        <translation>Einfügen</translation>
    </message>
    <message>
        <source>Paste key frame</source>
        <translation>Schlüsselbild einfügen</translation>
    </message>
    <message>
        <source>Remove key frame</source>
        <translation>Schlüsselbild entfernen</translation>
    </message>
    <message>
        <source>Remove keys</source>
        <translation>Schlüssel entfernen</translation>
    </message>
    <message>
        <source>Rename</source>
        <translation>Umbenennen</translation>
    </message>
    <message>
        <source>Repeat sequence</source>
        <translation>Sequenz wiederholen</translation>
    </message>
    <message>
        <source>Rotate</source>
        <translation>Drehen</translation>
    </message>
    <message>
        <source>Scale</source>
        <translation>Skalierung</translation>
    </message>
</context>
<context>
    <name>Message</name>
    <message>
        <source>it needs a frame of the scene after the picture&apos;s own</source>
        <translation>dafür braucht es ein Bild der Szene nach diesem</translation>
    </message>
    <message>
        <source>it needs a frame of the scene after the picture&apos;s own, and two cameras side by side at both</source>
        <translation>dafür braucht es ein Bild der Szene nach diesem und bei beiden zwei Kameras nebeneinander</translation>
    </message>
    <message>
        <source>it needs a frame of the scene before the picture&apos;s own</source>
        <translation>dafür braucht es ein Bild der Szene vor diesem</translation>
    </message>
    <message>
        <source>it needs a frame of the scene before the picture&apos;s own, and two cameras side by side at both</source>
        <translation>dafür braucht es ein Bild der Szene vor diesem und bei beiden zwei Kameras nebeneinander</translation>
    </message>
    <message>
        <source>it needs another camera in the run, or a pair of cameras that ends within the frames of the scene</source>
        <translation>dafür braucht es eine weitere Kamera</translation>
    </message>
    <message>
        <source>it needs two cameras side by side: the same K but cx, the same orientation, displaced along the x axis</source>
        <translation>dafür braucht es zwei Kameras nebeneinander: gleiches K bis auf cx, gleich ausgerichtet, entlang der x-Achse versetzt</translation>
    </message>
    <message>
        <source>the pixel is outside the image</source>
        <translation>das Pixel liegt außerhalb des Bildes</translation>
    </message>
    <message>
        <source>the point is outside the image</source>
        <translation>der Punkt liegt außerhalb des Bildes</translation>
    </message>
    <message>
        <source>number of cameras: expected 1 to 10000</source>
        <translation>Zahl der Kameras: 1 bis 10000 erwartet</translation>
    </message>
    <message>
        <source>columns and rows: expected 1 to 10000 cameras in all</source>
        <translation>Spalten und Zeilen: zusammen 1 bis 10000 Kameras erwartet</translation>
    </message>
    <message>
        <source>spacing: expected a number above 0</source>
        <translation>Abstand: eine Zahl über 0 erwartet</translation>
    </message>
    <message>
        <source>path: expected at least two different points</source>
        <translation>Weg: mindestens zwei verschiedene Punkte erwartet</translation>
    </message>
    <message>
        <source>eye, look-at or up of a camera is not finite</source>
        <translation>Auge, Blickpunkt oder Oben einer Kamera ist nicht endlich</translation>
    </message>
    <message>
        <source>eye and look-at of a camera coincide</source>
        <translation>Auge und Blickpunkt einer Kamera fallen zusammen</translation>
    </message>
    <message>
        <source>up vector of a camera is zero or parallel to its view</source>
        <translation>Oben einer Kamera ist null oder parallel zu ihrem Blick</translation>
    </message>
</context>
<context>
    <name>PixelText</name>
    <message>
        <source>background</source>
        <translation>Hintergrund</translation>
    </message>
    <message>
        <source>nothing</source>
        <translation>nichts</translation>
    </message>
    <message>
        <source>1 surface</source>
        <translation>1 Fläche</translation>
    </message>
    <message>
        <source>%1 surfaces</source>
        <translation>%1 Flächen</translation>
    </message>
    <message>
        <source>coverage %1 / 255</source>
        <translation>Bedeckung %1 / 255</translation>
    </message>
    <message>
        <source>%1 long</source>
        <translation>%1 lang</translation>
    </message>
    <message>
        <source>outside</source>
        <translation>außerhalb</translation>
    </message>
</context>
<context>
    <name>QObject</name>
    <message>
        <source>DGTk</source>
        <translation>DGTk</translation>
    </message>
    <message>
        <source>%1 is there already. Replace it?</source>
        <translation>%1 ist schon da. Ersetzen?</translation>
    </message>
    <message>
        <source>&amp;Add</source>
        <translation>&amp;Hinzufügen</translation>
    </message>
</context>
<context>
    <name>QPlatformTheme</name>
    <message>
        <source>OK</source>
        <translation>OK</translation>
    </message>
    <message>
        <source>Save</source>
        <translation>Speichern</translation>
    </message>
    <message>
        <source>Open</source>
        <translation>Öffnen</translation>
    </message>
    <message>
        <source>&amp;Yes</source>
        <translation>&amp;Ja</translation>
    </message>
    <message>
        <source>&amp;No</source>
        <translation>&amp;Nein</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Schließen</translation>
    </message>
    <message>
        <source>Discard</source>
        <translation>Verwerfen</translation>
    </message>
    <message>
        <source>Apply</source>
        <translation>Anwenden</translation>
    </message>
    <message>
        <source>Reset</source>
        <translation>Zurücksetzen</translation>
    </message>
</context>
<context>
    <name>Unit</name>
    <message>
        <source>pixels</source>
        <translation>Pixel</translation>
    </message>
    <message>
        <source>scene units</source>
        <translation>Szeneneinheiten</translation>
    </message>
    <message>
        <source>1 / scene units</source>
        <translation>1 / Szeneneinheiten</translation>
    </message>
    <message>
        <source>object units</source>
        <translation>Objekteinheiten</translation>
    </message>
    <message>
        <source>linear sRGB</source>
        <translation>lineares sRGB</translation>
    </message>
    <message>
        <source>camera response</source>
        <translation>Kennlinie der Kamera</translation>
    </message>
</context>
<context>
    <name>Visibility</name>
    <message>
        <source>unknown class</source>
        <translation>unbekannte Klasse</translation>
    </message>
    <message>
        <source>no surface</source>
        <translation>keine Fläche</translation>
    </message>
    <message>
        <source>visible</source>
        <translation>sichtbar</translation>
    </message>
    <message>
        <source>occluded by another object</source>
        <translation>von einem anderen Objekt verdeckt</translation>
    </message>
    <message>
        <source>occluded by its own object</source>
        <translation>vom eigenen Objekt verdeckt</translation>
    </message>
    <message>
        <source>outside the image</source>
        <translation>außerhalb des Bildes</translation>
    </message>
    <message>
        <source>behind the camera</source>
        <translation>hinter der Kamera</translation>
    </message>
</context>
<context>
    <name>dgtk::BackgroundWork</name>
    <message>
        <source>&amp;Cancel</source>
        <translation>&amp;Abbrechen</translation>
    </message>
</context>
<context>
    <name>dgtk::CameraArrayDialog</name>
    <message>
        <source>Add camera array</source>
        <translation>Kamerafeld hinzufügen</translation>
    </message>
    <message>
        <source>Ring</source>
        <translation>Ring</translation>
    </message>
    <message>
        <source>Hemisphere</source>
        <translation>Halbkugel</translation>
    </message>
    <message>
        <source>Grid</source>
        <translation>Gitter</translation>
    </message>
    <message>
        <source>Stereo pair</source>
        <translation>Stereopaar</translation>
    </message>
    <message>
        <source>Along a path</source>
        <translation>Entlang eines Wegs</translation>
    </message>
    <message>
        <source>A point a line: x y z, and where it looks: x y z</source>
        <translation>Je Zeile ein Punkt: x y z, und wohin sie blickt: x y z</translation>
    </message>
    <message>
        <source>x, y and z of a point in each line; after them, if it looks elsewhere than the others, those of its look-at point. A camera with key frames that is selected fills this in.</source>
        <translation>Je Zeile x, y und z eines Punktes; danach, wenn die Kamera dort anderswohin blickt, die des Blickpunkts. Eine ausgewählte Kamera mit Schlüsselbildern füllt das Feld.</translation>
    </message>
    <message>
        <source>&amp;Kind</source>
        <translation>&amp;Art</translation>
    </message>
    <message>
        <source>&amp;Eye</source>
        <translation>A&amp;uge</translation>
    </message>
    <message>
        <source>&amp;Look at</source>
        <translation>&amp;Blickpunkt</translation>
    </message>
    <message>
        <source>&amp;Field of view, ° (vertical)</source>
        <translation>B&amp;lickwinkel, ° (senkrecht)</translation>
    </message>
    <message>
        <source>&amp;Cameras</source>
        <translation>&amp;Kameras</translation>
    </message>
    <message>
        <source>C&amp;olumns</source>
        <translation>&amp;Spalten</translation>
    </message>
    <message>
        <source>&amp;Rows</source>
        <translation>&amp;Zeilen</translation>
    </message>
    <message>
        <source>&amp;Spacing, baseline</source>
        <translation>Abs&amp;tand, Basis</translation>
    </message>
    <message>
        <source>&amp;Path</source>
        <translation>&amp;Weg</translation>
    </message>
    <message>
        <source>&amp;Add</source>
        <translation>&amp;Hinzufügen</translation>
    </message>
    <message>
        <source>path: line %1: &quot;%2&quot; is no number</source>
        <translation>Weg: Zeile %1: „%2“ ist keine Zahl</translation>
    </message>
    <message>
        <source>path: line %1: expected 3 or 6 numbers, found %2</source>
        <translation>Weg: Zeile %1: 3 oder 6 Zahlen erwartet, %2 gefunden</translation>
    </message>
</context>
<context>
    <name>dgtk::CameraDialog</name>
    <message>
        <source>Add camera</source>
        <translation>Kamera hinzufügen</translation>
    </message>
    <message>
        <source>Shows the perspective view from there</source>
        <translation>Zeigt die perspektivische Ansicht von dort aus</translation>
    </message>
    <message>
        <source>by its field of view</source>
        <translation>durch seinen Bildwinkel</translation>
    </message>
    <message>
        <source>by its matrix K</source>
        <translation>durch seine Matrix K</translation>
    </message>
    <message>
        <source>&amp;Name</source>
        <translation>&amp;Name</translation>
    </message>
    <message>
        <source>&amp;Eye</source>
        <translation>&amp;Auge</translation>
    </message>
    <message>
        <source>&amp;Look at</source>
        <translation>&amp;Blickpunkt</translation>
    </message>
    <message>
        <source>&amp;Up</source>
        <translation>&amp;Oben</translation>
    </message>
    <message>
        <source>Len&amp;s</source>
        <translation>Ob&amp;jektiv</translation>
    </message>
    <message>
        <source>&amp;Field of view, ° (vertical)</source>
        <translation>B&amp;lickwinkel, ° (senkrecht)</translation>
    </message>
    <message>
        <source>Aspec&amp;t (0: square pixels)</source>
        <translation>&amp;Seitenverhältnis (0: quadratische Pixel)</translation>
    </message>
    <message>
        <source>f&amp;x, fy, cx, cy, pixels</source>
        <translation>&amp;fx, fy, cx, cy, Pixel</translation>
    </message>
    <message>
        <source>Si&amp;ze, pixels (0: as asked for)</source>
        <translation>&amp;Größe, Pixel (0: wie verlangt)</translation>
    </message>
    <message>
        <source>Near, fa&amp;r</source>
        <translation>Na&amp;h, fern</translation>
    </message>
    <message>
        <source>&amp;Preview</source>
        <translation>&amp;Vorschau</translation>
    </message>
</context>
<context>
    <name>dgtk::DatasetViewer</name>
    <message>
        <source>Opening %1 ...</source>
        <translation>%1 wird geöffnet ...</translation>
    </message>
    <message>
        <source>%1 - DGTk dataset</source>
        <translation>%1 - DGTk-Datensatz</translation>
    </message>
    <message>
        <source>&lt;p&gt;%1&lt;/p&gt;&lt;p&gt;Open the folder that &lt;i&gt;dgtk render&lt;/i&gt; wrote.&lt;/p&gt;</source>
        <translation>&lt;p&gt;%1&lt;/p&gt;&lt;p&gt;Den Ordner öffnen, den &lt;i&gt;dgtk render&lt;/i&gt; geschrieben hat.&lt;/p&gt;</translation>
    </message>
    <message>
        <source>DGTk</source>
        <translation>DGTk</translation>
    </message>
    <message>
        <source>&amp;File</source>
        <translation>&amp;Datei</translation>
    </message>
    <message>
        <source>&amp;Open dataset ...</source>
        <translation>Datensatz ö&amp;ffnen ...</translation>
    </message>
    <message>
        <source>&amp;Save the picture ...</source>
        <translation>Bild &amp;speichern ...</translation>
    </message>
    <message>
        <source>&amp;Copy the numbers</source>
        <translation>Zahlen &amp;kopieren</translation>
    </message>
    <message>
        <source>C&amp;lose</source>
        <translation>S&amp;chließen</translation>
    </message>
    <message>
        <source>&amp;View</source>
        <translation>&amp;Ansicht</translation>
    </message>
    <message>
        <source>&amp;Fit</source>
        <translation>&amp;Einpassen</translation>
    </message>
    <message>
        <source>&amp;One to one</source>
        <translation>E&amp;ins zu eins</translation>
    </message>
    <message>
        <source>Zoom &amp;in</source>
        <translation>&amp;Vergrößern</translation>
    </message>
    <message>
        <source>Zoom o&amp;ut</source>
        <translation>Ver&amp;kleinern</translation>
    </message>
    <message>
        <source>One &amp;picture</source>
        <translation>Ein &amp;Bild</translation>
    </message>
    <message>
        <source>&amp;Two pictures</source>
        <translation>&amp;Zwei Bilder</translation>
    </message>
    <message>
        <source>Fou&amp;r pictures</source>
        <translation>Vie&amp;r Bilder</translation>
    </message>
    <message>
        <source>All &amp;layers of one camera</source>
        <translation>A&amp;lle Ebenen einer Kamera</translation>
    </message>
    <message>
        <source>One layer of all &amp;cameras</source>
        <translation>Eine Ebene aller K&amp;ameras</translation>
    </message>
    <message>
        <source>&amp;Maximise or restore the picture</source>
        <translation>Bild &amp;maximieren oder wiederherstellen</translation>
    </message>
    <message>
        <source>F&amp;rames</source>
        <translation>&amp;Bilder</translation>
    </message>
    <message>
        <source>&amp;Play</source>
        <translation>&amp;Abspielen</translation>
    </message>
    <message>
        <source>&amp;Next</source>
        <translation>&amp;Nächstes</translation>
    </message>
    <message>
        <source>Pre&amp;vious</source>
        <translation>&amp;Voriges</translation>
    </message>
    <message>
        <source>&amp;First</source>
        <translation>&amp;Erstes</translation>
    </message>
    <message>
        <source>&amp;Last</source>
        <translation>&amp;Letztes</translation>
    </message>
    <message>
        <source>&amp;3D view</source>
        <translation>&amp;3D-Ansicht</translation>
    </message>
    <message>
        <source>&amp;Show the 3D view</source>
        <translation>3D-Ansicht &amp;zeigen</translation>
    </message>
    <message>
        <source>Points of &amp;all cameras</source>
        <translation>Punkte &amp;aller Kameras</translation>
    </message>
    <message>
        <source>Colours of the &amp;chosen picture</source>
        <translation>Farben des ge&amp;wählten Bildes</translation>
    </message>
    <message>
        <source>Show &amp;everything</source>
        <translation>A&amp;lles zeigen</translation>
    </message>
    <message>
        <source>&amp;Look from the camera</source>
        <translation>Von der &amp;Kamera aus sehen</translation>
    </message>
    <message>
        <source>&amp;Help</source>
        <translation>&amp;Hilfe</translation>
    </message>
    <message>
        <source>&amp;Mouse and keys</source>
        <translation>&amp;Maus und Tasten</translation>
    </message>
    <message>
        <source>Mouse and keys</source>
        <translation>Maus und Tasten</translation>
    </message>
    <message>
        <source>&lt;p&gt;Pictures. Wheel: zoom at the mouse, in all pictures. Drag: pan. Double click: this picture alone, or all again.&lt;br&gt;Arrow keys: the crosshair by a pixel, with Shift by ten; with Ctrl they pan.&lt;br&gt;F fit, 1 one to one, + and - zoom at the crosshair.&lt;/p&gt;&lt;p&gt;Frames. Comma and full stop: one back, one on; Home, End; P play.&lt;/p&gt;&lt;p&gt;3D view. Left drag or arrow keys: turn. Middle or Shift and left drag, Shift and arrow keys: pan. Right drag or wheel: zoom. Click a camera: its pictures in the chosen pane.&lt;/p&gt;</source>
        <translation>&lt;p&gt;Bilder. Rad: an der Maus zoomen, in allen Bildern. Ziehen: verschieben. Doppelklick: dieses Bild allein oder wieder alle.&lt;br&gt;Pfeiltasten: das Fadenkreuz um ein Pixel, mit Umschalt um zehn; mit Strg verschieben sie.&lt;br&gt;F einpassen, 1 eins zu eins, + und - zoomen am Fadenkreuz.&lt;/p&gt;&lt;p&gt;Zeit. Komma und Punkt: ein Bild zurück, eins weiter; Pos1, Ende; P abspielen.&lt;/p&gt;&lt;p&gt;3D-Ansicht. Links ziehen oder Pfeiltasten: drehen. Mitte oder Umschalt und links ziehen, Umschalt und Pfeiltasten: verschieben. Rechts ziehen oder Rad: zoomen. Klick auf eine Kamera: ihre Bilder im gewählten Feld.&lt;/p&gt;</translation>
    </message>
    <message>
        <source>Open a dataset</source>
        <translation>Datensatz öffnen</translation>
    </message>
    <message>
        <source>Save the picture</source>
        <translation>Bild speichern</translation>
    </message>
    <message>
        <source>PNG (*.png)</source>
        <translation>PNG (*.png)</translation>
    </message>
    <message>
        <source>%1 cannot be written.</source>
        <translation>%1 lässt sich nicht schreiben.</translation>
    </message>
    <message>
        <source>Dataset - DGTk</source>
        <translation>Datensatz - DGTk</translation>
    </message>
    <message>
        <source>Tools</source>
        <translation>Werkzeuge</translation>
    </message>
    <message>
        <source>Points need a layer depth, distance or position.</source>
        <translation>Punkte brauchen eine Ebene depth, distance oder position.</translation>
    </message>
    <message>
        <source>%L1 points</source>
        <translation>%L1 Punkte</translation>
    </message>
    <message>
        <source>No dataset is open. Open the folder that &lt;i&gt;dgtk render&lt;/i&gt; wrote, or drop it here.</source>
        <translation>Kein Datensatz ist offen. Den Ordner öffnen, den &lt;i&gt;dgtk render&lt;/i&gt; geschrieben hat, oder ihn hierher ziehen.</translation>
    </message>
    <message>
        <source>Open dataset ...</source>
        <translation>Datensatz öffnen ...</translation>
    </message>
    <message>
        <source>Frame %1 (%2 of %3)</source>
        <translation>Bild %1 (%2 von %3)</translation>
    </message>
    <message>
        <source>Cameras: %1, frames: %2, layers: %3</source>
        <translation>Kameras: %1, Bilder: %2, Ebenen: %3</translation>
    </message>
    <message>
        <source>&amp;Boxes of objects</source>
        <translation>Käs&amp;ten der Objekte</translation>
    </message>
    <message>
        <source>&amp;Sparse points</source>
        <translation>Einzelne &amp;Punkte</translation>
    </message>
    <message>
        <source>C&amp;alibration of the camera</source>
        <translation>Kalibrierun&amp;g der Kamera</translation>
    </message>
    <message>
        <source>Calibration</source>
        <translation>Kalibrierung</translation>
    </message>
    <message>
        <source>E&amp;xit</source>
        <translation>&amp;Beenden</translation>
    </message>
</context>
<context>
    <name>dgtk::DraftLabel</name>
    <message>
        <source>Draft</source>
        <translation>Entwurf</translation>
    </message>
</context>
<context>
    <name>dgtk::EditorLog</name>
    <message>
        <source>What happens is written here.</source>
        <translation>Was geschieht, steht hier.</translation>
    </message>
    <message>
        <source>Warning: %1</source>
        <translation>Warnung: %1</translation>
    </message>
    <message>
        <source>%1 more warnings: dgtk info shows all of them</source>
        <translation>%1 weitere Warnungen: dgtk info zeigt alle</translation>
    </message>
    <message>
        <source>%1; warnings in the log: %2</source>
        <translation>%1; Warnungen im Protokoll: %2</translation>
    </message>
</context>
<context>
    <name>dgtk::EditorState</name>
    <message>
        <source>The memory of this machine is not enough.</source>
        <translation>Der Speicher dieses Rechners reicht nicht.</translation>
    </message>
</context>
<context>
    <name>dgtk::ExportDialog</name>
    <message>
        <source>Browse ...</source>
        <translation>Durchsuchen ...</translation>
    </message>
    <message>
        <source>Export a dataset</source>
        <translation>Datensatz exportieren</translation>
    </message>
    <message>
        <source>&amp;Dataset</source>
        <translation>&amp;Datensatz</translation>
    </message>
    <message>
        <source>Folder of the dataset</source>
        <translation>Ordner des Datensatzes</translation>
    </message>
    <message>
        <source>&amp;Format</source>
        <translation>&amp;Format</translation>
    </message>
    <message>
        <source>F&amp;older</source>
        <translation>&amp;Ordner</translation>
    </message>
    <message>
        <source>Folder of the export</source>
        <translation>Ordner des Exports</translation>
    </message>
    <message>
        <source>&amp;Replace another export in this folder</source>
        <translation>&amp;Anderen Export in diesem Ordner ersetzen</translation>
    </message>
    <message>
        <source>&amp;Start</source>
        <translation>&amp;Start</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Schließen</translation>
    </message>
    <message>
        <source>Name the folders of the dataset and of the export.</source>
        <translation>Nennen Sie die Ordner des Datensatzes und des Exports.</translation>
    </message>
    <message>
        <source>Exporting ...</source>
        <translation>Exportieren ...</translation>
    </message>
    <message>
        <source>Stopped.</source>
        <translation>Angehalten.</translation>
    </message>
</context>
<context>
    <name>dgtk::FrameRow</name>
    <message>
        <source>Loop</source>
        <translation>Endlos</translation>
    </message>
    <message>
        <source>Frame</source>
        <translation>Bild</translation>
    </message>
    <message>
        <source> fps</source>
        <translation> Bilder/s</translation>
    </message>
    <message>
        <source>Frames a second</source>
        <translation>Bilder je Sekunde</translation>
    </message>
</context>
<context>
    <name>dgtk::HandleTool</name>
    <message>
        <source>     X, Y, Z: one axis, Shift: the two others; Ctrl: steps; Esc: as it was</source>
        <translation>     X, Y, Z: eine Achse, Umschalt: die beiden anderen; Strg: Stufen; Esc: wie zuvor</translation>
    </message>
    <message>
        <source>Rotate %1° about %2</source>
        <translation>Um %1° um %2 drehen</translation>
    </message>
    <message>
        <source>Rotate %1°</source>
        <translation>Um %1° drehen</translation>
    </message>
    <message>
        <source>%1, sheared by the parent&apos;s uneven scale</source>
        <translation>%1, durch die ungleiche Skalierung des Elternobjekts geschert</translation>
    </message>
    <message>
        <source>Scale by %1</source>
        <translation>Um %1 skalieren</translation>
    </message>
    <message>
        <source>Scale by %1, %2, %3</source>
        <translation>Um %1, %2, %3 skalieren</translation>
    </message>
    <message>
        <source>Move by %1, %2, %3</source>
        <translation>Um %1, %2, %3 verschieben</translation>
    </message>
    <message>
        <source>As it was before the drag</source>
        <translation>Wie vor dem Ziehen</translation>
    </message>
</context>
<context>
    <name>dgtk::LegendBar</name>
    <message>
        <source>Lower end of the colours</source>
        <translation>Unteres Ende der Farben</translation>
    </message>
    <message>
        <source>Upper end of the colours</source>
        <translation>Oberes Ende der Farben</translation>
    </message>
    <message>
        <source>Auto</source>
        <translation>Auto</translation>
    </message>
    <message>
        <source>Colours over the range of each picture</source>
        <translation>Farben über den Bereich jedes Bildes</translation>
    </message>
    <message>
        <source>&quot;%1&quot; is no number: the one before comes back</source>
        <translation>&quot;%1&quot; ist keine Zahl: die vorige kommt wieder</translation>
    </message>
</context>
<context>
    <name>dgtk::LegendStrip</name>
    <message>
        <source>+%1</source>
        <translation>+%1</translation>
    </message>
    <message>
        <source>full colour: %1 %2</source>
        <translation>volle Farbe: %1 %2</translation>
    </message>
    <message>
        <source>and %1 more</source>
        <translation>und %1 weitere</translation>
    </message>
    <message>
        <source>red right, green up, blue towards the camera</source>
        <translation>rot rechts, grün oben, blau zur Kamera</translation>
    </message>
    <message>
        <source>red u, green v, without whole numbers</source>
        <translation>rot u, grün v, ohne ganze Zahlen</translation>
    </message>
    <message>
        <source>red x, green y, over the range of each</source>
        <translation>rot x, grün y, je über ihren Bereich</translation>
    </message>
    <message>
        <source>red x, green y, blue z, over the range of each</source>
        <translation>rot x, grün y, blau z, je über ihren Bereich</translation>
    </message>
    <message>
        <source>each id has a colour of its own</source>
        <translation>jede Nummer hat eine eigene Farbe</translation>
    </message>
</context>
<context>
    <name>dgtk::LightDialog</name>
    <message>
        <source>Add light</source>
        <translation>Licht hinzufügen</translation>
    </message>
    <message>
        <source>&amp;Name</source>
        <translation>&amp;Name</translation>
    </message>
    <message>
        <source>&amp;Kind</source>
        <translation>&amp;Art</translation>
    </message>
    <message>
        <source>&amp;Position</source>
        <translation>&amp;Position</translation>
    </message>
    <message>
        <source>&amp;Target (directional, spot)</source>
        <translation>&amp;Ziel (gerichtet, Strahler)</translation>
    </message>
    <message>
        <source>&amp;Diffuse</source>
        <translation>&amp;Diffus</translation>
    </message>
    <message>
        <source>&amp;Specular</source>
        <translation>&amp;Glanz</translation>
    </message>
    <message>
        <source>A&amp;mbient</source>
        <translation>&amp;Umgebung</translation>
    </message>
    <message>
        <source>&amp;Intensity</source>
        <translation>&amp;Stärke</translation>
    </message>
    <message>
        <source>Atten&amp;uation (constant, linear, quadratic)</source>
        <translation>Abschwächung (konstant, &amp;linear, quadratisch)</translation>
    </message>
    <message>
        <source>&amp;Cone of a spot, °</source>
        <translation>&amp;Kegel eines Strahlers, °</translation>
    </message>
    <message>
        <source>E&amp;xponent of a spot</source>
        <translation>&amp;Exponent eines Strahlers</translation>
    </message>
    <message>
        <source>&amp;Enabled</source>
        <translation>E&amp;ingeschaltet</translation>
    </message>
</context>
<context>
    <name>dgtk::LightKind</name>
    <message>
        <source>point</source>
        <translation>Punktlicht</translation>
    </message>
    <message>
        <source>head</source>
        <translation>Kopflicht</translation>
    </message>
    <message>
        <source>directional</source>
        <translation>gerichtet</translation>
    </message>
    <message>
        <source>spot</source>
        <translation>Strahler</translation>
    </message>
</context>
<context>
    <name>dgtk::MainWindow</name>
    <message>
        <source>&amp;Move</source>
        <translation>&amp;Verschieben</translation>
    </message>
    <message>
        <source>Rotat&amp;e</source>
        <translation>&amp;Drehen</translation>
    </message>
    <message>
        <source>&amp;Scale</source>
        <translation>Skal&amp;ieren</translation>
    </message>
    <message>
        <source>Re&amp;name</source>
        <translation>U&amp;mbenennen</translation>
    </message>
    <message>
        <source>Make &amp;key frame</source>
        <translation>Schlüssel&amp;bild setzen</translation>
    </message>
    <message>
        <source>Pre&amp;view the camera</source>
        <translation>V&amp;orschau der Kamera</translation>
    </message>
    <message>
        <source>Pr&amp;operties</source>
        <translation>Eigenscha&amp;ften</translation>
    </message>
    <message>
        <source>Scene</source>
        <translation>Szene</translation>
    </message>
    <message>
        <source>Properties</source>
        <translation>Eigenschaften</translation>
    </message>
    <message>
        <source>Values</source>
        <translation>Werte</translation>
    </message>
    <message>
        <source>Time line</source>
        <translation>Zeitleiste</translation>
    </message>
    <message>
        <source>Log</source>
        <translation>Protokoll</translation>
    </message>
    <message>
        <source>&amp;File</source>
        <translation>&amp;Datei</translation>
    </message>
    <message>
        <source>&amp;New</source>
        <translation>&amp;Neu</translation>
    </message>
    <message>
        <source>&amp;Open ...</source>
        <translation>Ö&amp;ffnen ...</translation>
    </message>
    <message>
        <source>Open &amp;recent</source>
        <translation>&amp;Zuletzt geöffnet</translation>
    </message>
    <message>
        <source>&amp;Save</source>
        <translation>&amp;Speichern</translation>
    </message>
    <message>
        <source>Save &amp;as ...</source>
        <translation>Speichern &amp;unter ...</translation>
    </message>
    <message>
        <source>&amp;Import ...</source>
        <translation>&amp;Importieren ...</translation>
    </message>
    <message>
        <source>Export &amp;POV-Ray ...</source>
        <translation>Für &amp;POV-Ray exportieren ...</translation>
    </message>
    <message>
        <source>E&amp;xit</source>
        <translation>&amp;Beenden</translation>
    </message>
    <message>
        <source>&amp;Edit</source>
        <translation>&amp;Bearbeiten</translation>
    </message>
    <message>
        <source>&amp;Undo</source>
        <translation>&amp;Rückgängig</translation>
    </message>
    <message>
        <source>&amp;Redo</source>
        <translation>&amp;Wiederholen</translation>
    </message>
    <message>
        <source>Cu&amp;t</source>
        <translation>&amp;Ausschneiden</translation>
    </message>
    <message>
        <source>&amp;Copy</source>
        <translation>&amp;Kopieren</translation>
    </message>
    <message>
        <source>&amp;Paste</source>
        <translation>&amp;Einfügen</translation>
    </message>
    <message>
        <source>Dup&amp;licate</source>
        <translation>D&amp;uplizieren</translation>
    </message>
    <message>
        <source>&amp;Delete</source>
        <translation>&amp;Löschen</translation>
    </message>
    <message>
        <source>Select &amp;all</source>
        <translation>Alle&amp;s auswählen</translation>
    </message>
    <message>
        <source>&amp;View</source>
        <translation>&amp;Ansicht</translation>
    </message>
    <message>
        <source>Frame &amp;all</source>
        <translation>&amp;Alles zeigen</translation>
    </message>
    <message>
        <source>&amp;Frame selected</source>
        <translation>Aus&amp;wahl zeigen</translation>
    </message>
    <message>
        <source>&amp;Maximise or restore the view</source>
        <translation>Ansicht &amp;maximieren oder wiederherstellen</translation>
    </message>
    <message>
        <source>&amp;Wireframe</source>
        <translation>&amp;Drahtgitter</translation>
    </message>
    <message>
        <source>&amp;Shaded</source>
        <translation>&amp;Schattiert</translation>
    </message>
    <message>
        <source>&amp;Textured</source>
        <translation>Mit &amp;Texturen</translation>
    </message>
    <message>
        <source>S&amp;how in the perspective</source>
        <translation>In der Perspektive &amp;zeigen</translation>
    </message>
    <message>
        <source>&amp;Grid and axes</source>
        <translation>&amp;Gitter und Achsen</translation>
    </message>
    <message>
        <source>&amp;Tools</source>
        <translation>&amp;Werkzeuge</translation>
    </message>
    <message>
        <source>Add &amp;camera ...</source>
        <translation>&amp;Kamera hinzufügen ...</translation>
    </message>
    <message>
        <source>Add camera &amp;array ...</source>
        <translation>Kamera&amp;feld hinzufügen ...</translation>
    </message>
    <message>
        <source>Add &amp;light ...</source>
        <translation>&amp;Licht hinzufügen ...</translation>
    </message>
    <message>
        <source>&amp;Render configuration ...</source>
        <translation>&amp;Bilder berechnen ...</translation>
    </message>
    <message>
        <source>C&amp;orrespondence ...</source>
        <translation>K&amp;orrespondenzen ...</translation>
    </message>
    <message>
        <source>&amp;Help</source>
        <translation>&amp;Hilfe</translation>
    </message>
    <message>
        <source>&amp;Mouse and keys</source>
        <translation>&amp;Maus und Tasten</translation>
    </message>
    <message>
        <source>Mouse and keys</source>
        <translation>Maus und Tasten</translation>
    </message>
    <message>
        <source>&amp;About DGTk</source>
        <translation>&amp;Über DGTk</translation>
    </message>
    <message>
        <source>About DGTk</source>
        <translation>Über DGTk</translation>
    </message>
    <message>
        <source>DGTk: images and exact ground truth from described 3D scenes. The editor writes the scene files and runs the program dgtk; it adds no second way of doing anything.</source>
        <translation>DGTk: Bilder und exakte Referenzdaten aus beschriebenen 3D-Szenen. Der Editor schreibt die Szenendateien und führt das Programm dgtk aus; er fügt keinen zweiten Weg hinzu.</translation>
    </message>
    <message>
        <source>DGTk</source>
        <translation>DGTk</translation>
    </message>
    <message>
        <source>Tools</source>
        <translation>Werkzeuge</translation>
    </message>
    <message>
        <source>File &gt; Open opens a scene, File &gt; Import adds a model</source>
        <translation>Datei &gt; Öffnen öffnet eine Szene, Datei &gt; Importieren fügt ein Modell hinzu</translation>
    </message>
    <message>
        <source>%1[*] - DGTk</source>
        <translation>%1[*] - DGTk</translation>
    </message>
    <message>
        <source>Untitled</source>
        <translation>Ohne Titel</translation>
    </message>
    <message>
        <source>&amp;Undo %1</source>
        <translation>&amp;Rückgängig: %1</translation>
    </message>
    <message>
        <source>&amp;Redo %1</source>
        <translation>&amp;Wiederholen: %1</translation>
    </message>
    <message>
        <source>Open &amp;dataset ...</source>
        <translation>&amp;Datensatz öffnen ...</translation>
    </message>
    <message>
        <source>Open a dataset</source>
        <translation>Datensatz öffnen</translation>
    </message>
    <message>
        <source>Light of the s&amp;cene</source>
        <translation>&amp;Licht der Szene</translation>
    </message>
    <message>
        <source>&amp;Handles at the origin</source>
        <translation>&amp;Griffe am Ursprung</translation>
    </message>
    <message>
        <source>Rotates and scales about the object&apos;s origin; otherwise about the middle of its box</source>
        <translation>Dreht und skaliert um den Ursprung des Objekts; sonst um die Mitte seines Quaders</translation>
    </message>
    <message>
        <source>Find &amp;missing models ...</source>
        <translation>Fehlende &amp;Modelle suchen ...</translation>
    </message>
    <message>
        <source>The scene&apos;s lights and background in the views, without shadows; otherwise a light at each view&apos;s eye</source>
        <translation>Lichter und Hintergrund der Szene in den Ansichten, ohne Schatten; sonst ein Licht am Auge jeder Ansicht</translation>
    </message>
    <message>
        <source>Rendering is done</source>
        <translation>Die Bilder sind berechnet</translation>
    </message>
    <message>
        <source>Rendering has failed</source>
        <translation>Die Berechnung ist gescheitert</translation>
    </message>
    <message>
        <source>Rendering was interrupted</source>
        <translation>Die Berechnung wurde unterbrochen</translation>
    </message>
    <message>
        <source> (%1 of %2 pictures)</source>
        <translation> (%1 von %2 Bildern)</translation>
    </message>
    <message>
        <source>Rendered meanwhile: %1</source>
        <translation>Inzwischen berechnet: %1</translation>
    </message>
    <message>
        <source>Rendering into %1 has failed: %2</source>
        <translation>Die Berechnung in %1 ist gescheitert: %2</translation>
    </message>
    <message>
        <source>Rendering into %1 was interrupted%2. It can go on: Tools &gt; Render configuration.</source>
        <translation>Die Berechnung in %1 wurde unterbrochen%2. Sie kann weitergehen: Werkzeuge &gt; Bilder berechnen.</translation>
    </message>
    <message>
        <source>A dataset is being rendered. %1</source>
        <translation>Ein Datensatz wird berechnet. %1</translation>
    </message>
    <message>
        <source>In the background it goes on without this window, and the next start shows it again. Stopped, it can go on later.</source>
        <translation>Im Hintergrund geht das ohne dieses Fenster weiter, und der nächste Start zeigt es wieder. Angehalten kann es später weitergehen.</translation>
    </message>
    <message>
        <source>Go on in the &amp;background</source>
        <translation>Im &amp;Hintergrund weiter</translation>
    </message>
    <message>
        <source>&amp;Stop</source>
        <translation>&amp;Anhalten</translation>
    </message>
    <message>
        <source>S&amp;tay here</source>
        <translation>Hier &amp;bleiben</translation>
    </message>
    <message>
        <source>Expor&amp;t a dataset ...</source>
        <translation>Datensatz e&amp;xportieren ...</translation>
    </message>
    <message>
        <source>Exported meanwhile: %1</source>
        <translation>Inzwischen exportiert: %1</translation>
    </message>
    <message>
        <source>The export into %1 has ended: %2</source>
        <translation>Der Export nach %1 ist beendet: %2</translation>
    </message>
    <message>
        <source>Sampl&amp;e a random scene ...</source>
        <translation>Zufällige Szene zi&amp;ehen ...</translation>
    </message>
    <message>
        <source>Sampled meanwhile: %1</source>
        <translation>Inzwischen gezogen: %1</translation>
    </message>
    <message>
        <source>Sampling into %1 has ended: %2</source>
        <translation>Das Ziehen nach %1 ist zu Ende: %2</translation>
    </message>
    <message>
        <source>%1 is not opened: it is no file of this machine</source>
        <translation>%1 wird nicht geöffnet: es ist keine Datei dieses Rechners</translation>
    </message>
    <message>
        <source>Warning: %1 has changed since it was read here. Open the scene again to see it as it is rendered.</source>
        <translation>Warnung: %1 hat sich geändert, seit es hier gelesen wurde. Öffnen Sie die Szene noch einmal, um sie so zu sehen, wie sie berechnet wird.</translation>
    </message>
    <message>
        <source>%1 objects deleted, among them what hangs on what was selected: %2</source>
        <translation>%1 Objekte gelöscht, darunter was an Ausgewähltem hängt: %2</translation>
    </message>
    <message>
        <source>&lt;p&gt;Click: select; with Ctrl: add. Drag what is selected: move it in the view&apos;s plane. Drag its handles: move, rotate or scale it (1, 2, 3), about its middle or its origin (O).&lt;br&gt;During a drag: X, Y, Z keep to an axis, with Shift to the two others; Ctrl: steps; Esc: as it was.&lt;br&gt;Left drag: turn the perspective, pan the others. Middle or Shift and left: pan.&lt;br&gt;Right drag or wheel: zoom. Right click: menu. Double click: one view or all four.&lt;/p&gt;&lt;p&gt;R frame all, F frame selected, W wireframe, S shaded, T textured, L the scene&apos;s light, G grid, F11 maximise.&lt;br&gt;Ctrl+1 to Ctrl+9: the perspective shows a layer, Ctrl+0: colour.&lt;br&gt;Arrows turn or pan the view with a frame about it, with Shift they pan; + and - zoom.&lt;/p&gt;&lt;p&gt;Ctrl+Z undo, Ctrl+Shift+Z redo, Del delete, F2 rename, K make a key frame, P preview the camera, Alt+Return properties.&lt;/p&gt;&lt;p&gt;In the time line: Space plays, Left and Right go through the frames, with Ctrl from key to key. Alt+Left and Alt+Right move the key (with Shift the scene&apos;s, with Ctrl a copy), Shift+K removes it. [ and ] move the start of a sequence, { and } its end.&lt;/p&gt;</source>
        <translation>&lt;p&gt;Klick: auswählen; mit Strg: dazunehmen. Ausgewähltes ziehen: in der Ebene der Ansicht verschieben. Griffe ziehen: verschieben, drehen oder skalieren (1, 2, 3), um die Mitte oder den Ursprung (O).&lt;br&gt;Beim Ziehen: X, Y, Z halten an einer Achse fest, mit Umschalt an den beiden anderen; Strg: Stufen; Esc: wie zuvor.&lt;br&gt;Links ziehen: die Perspektive drehen, die anderen verschieben. Mitte oder Umschalt und links: verschieben.&lt;br&gt;Rechts ziehen oder Rad: zoomen. Rechtsklick: Menü. Doppelklick: eine Ansicht oder alle vier.&lt;/p&gt;&lt;p&gt;R alles zeigen, F Auswahl zeigen, W Drahtgitter, S schattiert, T mit Texturen, L Licht der Szene, G Gitter, F11 maximieren.&lt;br&gt;Strg+1 bis Strg+9: die Perspektive zeigt eine Ebene, Strg+0: Farbe.&lt;br&gt;Pfeile drehen oder verschieben die Ansicht mit dem Rahmen, mit Umschalt verschieben sie; + und - zoomen.&lt;/p&gt;&lt;p&gt;Strg+Z rückgängig, Strg+Umschalt+Z wiederholen, Entf löschen, F2 umbenennen, K Schlüsselbild setzen, P Vorschau der Kamera, Alt+Eingabe Eigenschaften.&lt;/p&gt;&lt;p&gt;In der Zeitleiste: Leertaste spielt ab, Links und Rechts gehen durch die Bilder, mit Strg von Schlüssel zu Schlüssel. Alt+Links und Alt+Rechts verschieben den Schlüssel (mit Umschalt den der Szene, mit Strg eine Kopie), Umschalt+K entfernt ihn. [ und ] verschieben den Anfang einer Sequenz, { und } ihr Ende.&lt;/p&gt;</translation>
    </message>
    <message>
        <source>R&amp;eset layout</source>
        <translation>Anordnung wiede&amp;rherstellen</translation>
    </message>
</context>
<context>
    <name>dgtk::MatchDialog</name>
    <message>
        <source>The scene has no cameras yet. Tools &gt; Add camera array &gt; Stereo pair makes two that see the same.</source>
        <translation>Die Szene hat noch keine Kameras. Werkzeuge &gt; Kamerafeld hinzufügen &gt; Stereopaar macht zwei, die dasselbe sehen.</translation>
    </message>
    <message>
        <source>id %1</source>
        <translation>Nr. %1</translation>
    </message>
    <message>
        <source>Open correspondences</source>
        <translation>Korrespondenzen öffnen</translation>
    </message>
    <message>
        <source>Correspondences (*.txt);;All files (*)</source>
        <translation>Korrespondenzen (*.txt);;Alle Dateien (*)</translation>
    </message>
    <message>
        <source>Save correspondences</source>
        <translation>Korrespondenzen speichern</translation>
    </message>
    <message>
        <source>Correspondences (*.txt)</source>
        <translation>Korrespondenzen (*.txt)</translation>
    </message>
    <message>
        <source>Correspondence</source>
        <translation>Korrespondenzen</translation>
    </message>
    <message>
        <source>&amp;Left camera</source>
        <translation>&amp;Linke Kamera</translation>
    </message>
    <message>
        <source>&amp;Right camera</source>
        <translation>&amp;Rechte Kamera</translation>
    </message>
    <message>
        <source>Frame</source>
        <translation>Bild</translation>
    </message>
    <message>
        <source>x %1  y %2</source>
        <translation>x %1  y %2</translation>
    </message>
    <message>
        <source>&amp;Show</source>
        <translation>&amp;Zeigen</translation>
    </message>
    <message>
        <source>&amp;Pixel centres only</source>
        <translation>Nur &amp;Pixelmitten</translation>
    </message>
    <message>
        <source>A click takes the centre of its pixel, as the dense layers of a dataset do</source>
        <translation>Ein Klick nimmt die Mitte seines Pixels, wie die dichten Ebenen eines Datensatzes</translation>
    </message>
    <message>
        <source>S&amp;wap</source>
        <translation>&amp;Tauschen</translation>
    </message>
    <message>
        <source>Point</source>
        <translation>Punkt</translation>
    </message>
    <message>
        <source>Its match</source>
        <translation>Entsprechung</translation>
    </message>
    <message>
        <source>Visibility there</source>
        <translation>Sichtbarkeit dort</translation>
    </message>
    <message>
        <source>Surface</source>
        <translation>Fläche</translation>
    </message>
    <message>
        <source>Depth</source>
        <translation>Tiefe</translation>
    </message>
    <message>
        <source>Depth there</source>
        <translation>Tiefe dort</translation>
    </message>
    <message>
        <source>World</source>
        <translation>Welt</translation>
    </message>
    <message>
        <source>World there</source>
        <translation>Welt dort</translation>
    </message>
    <message>
        <source>Epipolar line</source>
        <translation>Epipolarlinie</translation>
    </message>
    <message>
        <source>Match to line</source>
        <translation>Entsprechung zur Linie</translation>
    </message>
    <message>
        <source>&amp;Add pair</source>
        <translation>Paar &amp;aufnehmen</translation>
    </message>
    <message>
        <source>Adds the point and its match to the list (Ctrl+Return)</source>
        <translation>Nimmt den Punkt und seine Entsprechung in die Liste auf (Strg+Eingabe)</translation>
    </message>
    <message>
        <source>&amp;Delete</source>
        <translation>&amp;Löschen</translation>
    </message>
    <message>
        <source>&amp;Clear</source>
        <translation>&amp;Leeren</translation>
    </message>
    <message>
        <source>&amp;Open ...</source>
        <translation>Ö&amp;ffnen ...</translation>
    </message>
    <message>
        <source>Sa&amp;ve ...</source>
        <translation>&amp;Speichern ...</translation>
    </message>
    <message>
        <source>%1, frame %2:  %3, %4</source>
        <translation>%1, Bild %2:  %3, %4</translation>
    </message>
    <message>
        <source>Click a point of either picture.</source>
        <translation>Einen Punkt in einem der Bilder anklicken.</translation>
    </message>
    <message>
        <source>%1, part %2, triangle %3</source>
        <translation>%1, Teil %2, Dreieck %3</translation>
    </message>
    <message>
        <source>nothing</source>
        <translation>nichts</translation>
    </message>
    <message>
        <source>%1 pixels</source>
        <translation>%1 Pixel</translation>
    </message>
    <message>
        <source>The list of correspondences is not saved.</source>
        <translation>Die Liste der Korrespondenzen ist nicht gespeichert.</translation>
    </message>
    <message>
        <source>%1 (%2)</source>
        <translation>%1 (%2)</translation>
    </message>
    <message>
        <source>Undo</source>
        <translation>Rückgängig</translation>
    </message>
    <message>
        <source>Redo</source>
        <translation>Wiederholen</translation>
    </message>
    <message>
        <source>The scene has no view of %1, frame %2, with %3 x %4 pixels.</source>
        <translation>Die Szene hat keine Ansicht von %1, Bild %2, mit %3 x %4 Pixeln.</translation>
    </message>
    <message>
        <source>none: the ray is a point in the other picture, or at infinity</source>
        <translation>keine: der Strahl ist im anderen Bild ein Punkt oder im Unendlichen</translation>
    </message>
    <message>
        <source>none: one of the cameras is not linear, or has a rolling shutter</source>
        <translation>keine: eine der Kameras ist nicht linear oder hat einen Rolling Shutter</translation>
    </message>
</context>
<context>
    <name>dgtk::MatchPane</name>
    <message>
        <source>Click a point. Wheel: zoom, drag: pan, double click: all of it, arrows: move the point.</source>
        <translation>Einen Punkt anklicken. Rad: vergrößern, ziehen: schieben, Doppelklick: alles, Pfeiltasten: Punkt bewegen.</translation>
    </message>
</context>
<context>
    <name>dgtk::MatchTable</name>
    <message>
        <source>From</source>
        <translation>Von</translation>
    </message>
    <message>
        <source>x</source>
        <translation>x</translation>
    </message>
    <message>
        <source>y</source>
        <translation>y</translation>
    </message>
    <message>
        <source>To</source>
        <translation>Nach</translation>
    </message>
    <message>
        <source>x&apos;</source>
        <translation>x&apos;</translation>
    </message>
    <message>
        <source>y&apos;</source>
        <translation>y&apos;</translation>
    </message>
    <message>
        <source>Visibility</source>
        <translation>Sichtbarkeit</translation>
    </message>
    <message>
        <source>Object</source>
        <translation>Objekt</translation>
    </message>
    <message>
        <source>Click a point of a picture, then Add pair. Open reads a list that was saved.</source>
        <translation>Einen Punkt eines Bildes anklicken, dann Paar aufnehmen. Öffnen liest eine gespeicherte Liste.</translation>
    </message>
    <message>
        <source>The scene does not have this pair now. Click it, then Add pair, to find it again.</source>
        <translation>Die Szene hat dieses Paar so nicht mehr. Anklicken, dann Paar aufnehmen, um es neu zu finden.</translation>
    </message>
</context>
<context>
    <name>dgtk::NumberRow</name>
    <message>
        <source>&quot;%1&quot; is no number that can be used here</source>
        <translation>&quot;%1&quot; ist keine Zahl, die hier gebraucht werden kann</translation>
    </message>
    <message>
        <source>&quot;%1&quot;: expected a number from %2 to %3</source>
        <translation>&quot;%1&quot;: erwartet ist eine Zahl von %2 bis %3</translation>
    </message>
    <message>
        <source>&quot;%1&quot;: expected a whole number</source>
        <translation>&quot;%1&quot;: erwartet ist eine ganze Zahl</translation>
    </message>
    <message>
        <source>&quot;%1&quot;: expected at most %2 decimals</source>
        <translation>&quot;%1&quot;: erwartet sind höchstens %2 Nachkommastellen</translation>
    </message>
</context>
<context>
    <name>dgtk::PictureLoader</name>
    <message>
        <source>No picture of this layer here</source>
        <translation>Kein Bild dieser Ebene hier</translation>
    </message>
</context>
<context>
    <name>dgtk::PicturePane</name>
    <message>
        <source>Camera of this picture</source>
        <translation>Kamera dieses Bildes</translation>
    </message>
    <message>
        <source>Layer of this picture</source>
        <translation>Ebene dieses Bildes</translation>
    </message>
    <message>
        <source>Which surface along each ray, from the nearest</source>
        <translation>Die wievielte Fläche auf jedem Strahl, von der nächsten an</translation>
    </message>
    <message>
        <source>%1 (nearby; zoom in)</source>
        <translation>%1 (in der Nähe; vergrößern)</translation>
    </message>
    <message>
        <source>no. </source>
        <translation>Nr. </translation>
    </message>
    <message>
        <source>Which object, by its id</source>
        <translation>Welches Objekt, nach seiner Nummer</translation>
    </message>
</context>
<context>
    <name>dgtk::PropertiesPanel</name>
    <message>
        <source>Name</source>
        <translation>Name</translation>
    </message>
    <message>
        <source>Change %1</source>
        <translation>%1 ändern</translation>
    </message>
    <message>
        <source>Rotation, °</source>
        <translation>Drehung, °</translation>
    </message>
    <message>
        <source>Quaternion</source>
        <translation>Quaternion</translation>
    </message>
    <message>
        <source>Class</source>
        <translation>Klasse</translation>
    </message>
    <message>
        <source>Model</source>
        <translation>Modell</translation>
    </message>
    <message>
        <source>Parent</source>
        <translation>Gehört zu</translation>
    </message>
    <message>
        <source>Position</source>
        <translation>Position</translation>
    </message>
    <message>
        <source>Scale</source>
        <translation>Skalierung</translation>
    </message>
    <message>
        <source>Visible</source>
        <translation>Sichtbar</translation>
    </message>
    <message>
        <source>Kind</source>
        <translation>Art</translation>
    </message>
    <message>
        <source>Enabled</source>
        <translation>Eingeschaltet</translation>
    </message>
    <message>
        <source>Target</source>
        <translation>Ziel</translation>
    </message>
    <message>
        <source>Diffuse</source>
        <translation>Diffus</translation>
    </message>
    <message>
        <source>Specular</source>
        <translation>Glanz</translation>
    </message>
    <message>
        <source>Ambient</source>
        <translation>Umgebung</translation>
    </message>
    <message>
        <source>Intensity</source>
        <translation>Stärke</translation>
    </message>
    <message>
        <source>Cone, °</source>
        <translation>Kegel, °</translation>
    </message>
    <message>
        <source>Exponent</source>
        <translation>Exponent</translation>
    </message>
    <message>
        <source>Shadows</source>
        <translation>Schatten</translation>
    </message>
    <message>
        <source>Eye</source>
        <translation>Auge</translation>
    </message>
    <message>
        <source>Look at</source>
        <translation>Blickpunkt</translation>
    </message>
    <message>
        <source>Up</source>
        <translation>Oben</translation>
    </message>
    <message>
        <source>View height</source>
        <translation>Bildhöhe</translation>
    </message>
    <message>
        <source>Lens</source>
        <translation>Objektiv</translation>
    </message>
    <message>
        <source>by its matrix K</source>
        <translation>durch seine Matrix K</translation>
    </message>
    <message>
        <source>Field of view, °</source>
        <translation>Blickwinkel, °</translation>
    </message>
    <message>
        <source>Aspect (0: square)</source>
        <translation>Seitenverhältnis (0: quadratisch)</translation>
    </message>
    <message>
        <source>Near</source>
        <translation>Nah</translation>
    </message>
    <message>
        <source>Far</source>
        <translation>Fern</translation>
    </message>
    <message>
        <source>Size, pixels</source>
        <translation>Größe, Pixel</translation>
    </message>
    <message>
        <source>Sequence</source>
        <translation>Sequenz</translation>
    </message>
    <message>
        <source>Begins at frame</source>
        <translation>Beginnt bei Bild</translation>
    </message>
    <message>
        <source>Speed</source>
        <translation>Tempo</translation>
    </message>
    <message>
        <source>Repeat</source>
        <translation>Wiederholen</translation>
    </message>
    <message>
        <source>Nothing is selected: these are the values of the scene. Click an object, light or camera in a view or in the scene tree to see its own.</source>
        <translation>Nichts ist ausgewählt: dies sind die Werte der Szene. Ein Klick auf ein Objekt, Licht oder eine Kamera in einer Ansicht oder im Baum zeigt deren Werte.</translation>
    </message>
    <message>
        <source>%1, %2</source>
        <translation>%1, %2</translation>
    </message>
    <message>
        <source>by its field of view</source>
        <translation>durch seinen Bildwinkel</translation>
    </message>
    <message>
        <source>fx, fy, pixels</source>
        <translation>fx, fy, Pixel</translation>
    </message>
    <message>
        <source>cx, cy, pixels</source>
        <translation>cx, cy, Pixel</translation>
    </message>
    <message>
        <source>Skew, pixels</source>
        <translation>Scherung, Pixel</translation>
    </message>
    <message>
        <source>Units</source>
        <translation>Einheit</translation>
    </message>
    <message>
        <source>Up axis</source>
        <translation>Achse nach oben</translation>
    </message>
    <message>
        <source>Background</source>
        <translation>Hintergrund</translation>
    </message>
    <message>
        <source>Fog</source>
        <translation>Nebel</translation>
    </message>
    <message>
        <source>Fog&apos;s density</source>
        <translation>Dichte des Nebels</translation>
    </message>
    <message>
        <source>Fog begins at</source>
        <translation>Nebel ab</translation>
    </message>
    <message>
        <source>The field of view has key frames, which a matrix cannot have: remove them first.</source>
        <translation>Der Bildwinkel hat Schlüsselbilder, die eine Matrix nicht haben kann: zuerst entfernen.</translation>
    </message>
    <message>
        <source>Attenuation (constant, linear, quadratic)</source>
        <translation>Abschwächung (konstant, linear, quadratisch)</translation>
    </message>
    <message>
        <source>%1 has key frames, so a matrix and a field of view do not say the same: remove them first.</source>
        <translation>%1 hat Schlüsselbilder, so dass Matrix und Bildwinkel nicht dasselbe sagen: sie zuerst entfernen.</translation>
    </message>
    <message>
        <source>A field of view is below 180 degrees: a wider lens needs its matrix.</source>
        <translation>Ein Bildwinkel ist kleiner als 180 Grad: ein weiteres Objektiv braucht seine Matrix.</translation>
    </message>
    <message>
        <source>A field of view has its principal point in the middle of the image and no skew: set cx, cy to %1, %2 and the skew to 0 first.</source>
        <translation>Ein Bildwinkel hat seinen Hauptpunkt in der Bildmitte und keine Scherung: zuerst cx, cy auf %1, %2 und die Scherung auf 0 setzen.</translation>
    </message>
    <message numerus="yes">
        <source>%n selected: the first&apos;s values, changed for all with the same rows</source>
        <translation>
            <numerusform>%n ausgewählt: Werte des ersten, Änderungen für alle mit denselben Zeilen</numerusform>
            <numerusform>%n ausgewählt: Werte des ersten, Änderungen für alle mit denselben Zeilen</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>dgtk::ReadOut</name>
    <message>
        <source>Camera</source>
        <translation>Kamera</translation>
    </message>
    <message>
        <source>Layer</source>
        <translation>Ebene</translation>
    </message>
    <message>
        <source>Value</source>
        <translation>Wert</translation>
    </message>
    <message>
        <source>World point</source>
        <translation>Weltpunkt</translation>
    </message>
    <message>
        <source>Pixel (%1, %2)</source>
        <translation>Pixel (%1, %2)</translation>
    </message>
    <message>
        <source>Point at a picture to read its numbers.</source>
        <translation>Auf ein Bild zeigen, um seine Zahlen zu lesen.</translation>
    </message>
</context>
<context>
    <name>dgtk::RenderCameras</name>
    <message>
        <source>&amp;Cameras to render:</source>
        <translation>&amp;Zu berechnende Kameras:</translation>
    </message>
    <message>
        <source>&amp;Aspect (0: square pixels)</source>
        <translation>&amp;Seitenverhältnis (0: quadratische Pixel)</translation>
    </message>
    <message>
        <source>&amp;Near plane</source>
        <translation>&amp;Nahe Ebene</translation>
    </message>
    <message>
        <source>Fa&amp;r plane</source>
        <translation>&amp;Ferne Ebene</translation>
    </message>
    <message>
        <source>&amp;Every camera in its own size: that of the chosen one is</source>
        <translation>&amp;Jede Kamera in ihrer eigenen Größe; die der gewählten ist</translation>
    </message>
    <message>
        <source>Image &amp;width</source>
        <translation>&amp;Bildbreite</translation>
    </message>
    <message>
        <source>Image &amp;height</source>
        <translation>B&amp;ildhöhe</translation>
    </message>
    <message>
        <source>&amp;View height</source>
        <translation>Bildhöhe in &amp;der Welt</translation>
    </message>
    <message>
        <source>Field of &amp;view, ° (vertical)</source>
        <translation>B&amp;lickwinkel, ° (senkrecht)</translation>
    </message>
    <message>
        <source>The scene has no camera. Add one with Tools &gt; Add camera.</source>
        <translation>Die Szene hat keine Kamera. Werkzeuge &gt; Kamera hinzufügen macht eine.</translation>
    </message>
    <message>
        <source>%1 has no pose at this frame: its eye is at its look-at point.</source>
        <translation>%1 hat in diesem Bild keine Lage: das Auge ist am Blickpunkt.</translation>
    </message>
    <message>
        <source>units</source>
        <translation>Einheiten</translation>
    </message>
    <message>
        <source>at every depth</source>
        <translation>in jeder Tiefe</translation>
    </message>
    <message>
        <source>at the far plane</source>
        <translation>an der fernen Ebene</translation>
    </message>
    <message>
        <source>between near and far plane (the thesis&apos;s number)</source>
        <translation>zwischen naher und ferner Ebene (Zahl der Thesis)</translation>
    </message>
    <message>
        <source>%1: %2 x %3 pixels. A pixel is, in x and y:</source>
        <translation>%1: %2 x %3 Pixel. Ein Pixel ist in x und y:</translation>
    </message>
    <message>
        <source>at the look-at point, %1 %2 away</source>
        <translation>am Blickpunkt, %1 %2 entfernt</translation>
    </message>
</context>
<context>
    <name>dgtk::RenderDialog</name>
    <message>
        <source>Render configuration</source>
        <translation>Bilder berechnen</translation>
    </message>
    <message>
        <source>Info</source>
        <translation>Info</translation>
    </message>
    <message>
        <source>Cameras</source>
        <translation>Kameras</translation>
    </message>
    <message>
        <source>Controls</source>
        <translation>Einstellungen</translation>
    </message>
    <message>
        <source>&lt;table cellpadding=&apos;4&apos;&gt;&lt;tr&gt;&lt;td&gt;Scene&lt;/td&gt;&lt;td&gt;%1&lt;/td&gt;&lt;/tr&gt;&lt;tr&gt;&lt;td&gt;Objects&lt;/td&gt;&lt;td&gt;%2&lt;/td&gt;&lt;/tr&gt;&lt;tr&gt;&lt;td&gt;Lights&lt;/td&gt;&lt;td&gt;%3&lt;/td&gt;&lt;/tr&gt;&lt;tr&gt;&lt;td&gt;Cameras&lt;/td&gt;&lt;td&gt;%4&lt;/td&gt;&lt;/tr&gt;&lt;tr&gt;&lt;td&gt;Frames&lt;/td&gt;&lt;td&gt;%5 to %6&lt;/td&gt;&lt;/tr&gt;&lt;tr&gt;&lt;td&gt;Key frames&lt;/td&gt;&lt;td&gt;%7&lt;/td&gt;&lt;/tr&gt;&lt;/table&gt;</source>
        <translation>&lt;table cellpadding=&apos;4&apos;&gt;&lt;tr&gt;&lt;td&gt;Szene&lt;/td&gt;&lt;td&gt;%1&lt;/td&gt;&lt;/tr&gt;&lt;tr&gt;&lt;td&gt;Objekte&lt;/td&gt;&lt;td&gt;%2&lt;/td&gt;&lt;/tr&gt;&lt;tr&gt;&lt;td&gt;Lichter&lt;/td&gt;&lt;td&gt;%3&lt;/td&gt;&lt;/tr&gt;&lt;tr&gt;&lt;td&gt;Kameras&lt;/td&gt;&lt;td&gt;%4&lt;/td&gt;&lt;/tr&gt;&lt;tr&gt;&lt;td&gt;Bilder&lt;/td&gt;&lt;td&gt;%5 bis %6&lt;/td&gt;&lt;/tr&gt;&lt;tr&gt;&lt;td&gt;Schlüsselbilder&lt;/td&gt;&lt;td&gt;%7&lt;/td&gt;&lt;/tr&gt;&lt;/table&gt;</translation>
    </message>
    <message>
        <source>not saved yet</source>
        <translation>noch nicht gespeichert</translation>
    </message>
    <message>
        <source>The scene has no camera. Add one with Tools &gt; Add camera.</source>
        <translation>Die Szene hat keine Kamera. Werkzeuge &gt; Kamera hinzufügen macht eine.</translation>
    </message>
    <message>
        <source>Folder of the dataset</source>
        <translation>Ordner des Datensatzes</translation>
    </message>
    <message>
        <source>Check at least one camera on the page Cameras.</source>
        <translation>Auf der Seite Kameras mindestens eine Kamera ankreuzen.</translation>
    </message>
    <message>
        <source>Check at least one layer.</source>
        <translation>Mindestens eine Ebene ankreuzen.</translation>
    </message>
    <message>
        <source>Name a folder for the dataset.</source>
        <translation>Einen Ordner für den Datensatz nennen.</translation>
    </message>
    <message>
        <source>Rendering ...</source>
        <translation>Wird berechnet ...</translation>
    </message>
    <message>
        <source>%1, %2 left</source>
        <translation>%1, noch %2</translation>
    </message>
    <message>
        <source>Stopped. Start goes on where it stopped.</source>
        <translation>Angehalten. Start macht dort weiter.</translation>
    </message>
    <message>
        <source>Layers</source>
        <translation>Ebenen</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Schließen</translation>
    </message>
    <message>
        <source>Pictures: %1 of %2</source>
        <translation>Bilder: %1 von %2</translation>
    </message>
    <message>
        <source>&amp;All</source>
        <translation>&amp;Alle</translation>
    </message>
    <message>
        <source>&amp;None</source>
        <translation>&amp;Keine</translation>
    </message>
    <message>
        <source>&amp;First frame</source>
        <translation>&amp;Erstes Bild</translation>
    </message>
    <message>
        <source>Until you choose another, the first of the scene</source>
        <translation>Solange kein anderes gewählt ist, das erste der Szene</translation>
    </message>
    <message>
        <source>&amp;Last frame</source>
        <translation>Le&amp;tztes Bild</translation>
    </message>
    <message>
        <source>Until you choose another, the last of the scene</source>
        <translation>Solange kein anderes gewählt ist, das letzte der Szene</translation>
    </message>
    <message>
        <source>E&amp;very</source>
        <translation>Jedes &amp;wievielte</translation>
    </message>
    <message>
        <source>2 renders every second frame</source>
        <translation>2 rendert jedes zweite Bild</translation>
    </message>
    <message>
        <source>F&amp;older</source>
        <translation>&amp;Ordner</translation>
    </message>
    <message>
        <source>&amp;Browse ...</source>
        <translation>D&amp;urchsuchen ...</translation>
    </message>
    <message>
        <source>Loo&amp;k at the result</source>
        <translation>Er&amp;gebnis ansehen</translation>
    </message>
    <message>
        <source>O&amp;pen the folder</source>
        <translation>I&amp;m Dateimanager öffnen</translation>
    </message>
    <message>
        <source>&amp;Start</source>
        <translation>&amp;Start</translation>
    </message>
    <message>
        <source>Stopping ... Cancel again ends what is being drawn, too.</source>
        <translation>Wird angehalten ... Noch einmal Abbrechen beendet auch, was gerade gezeichnet wird.</translation>
    </message>
    <message>
        <source>The run was ended from outside. Start goes on where it ended.</source>
        <translation>Der Lauf wurde von außen beendet. Start macht dort weiter.</translation>
    </message>
    <message>
        <source>The run was ended from outside.</source>
        <translation>Der Lauf wurde von außen beendet.</translation>
    </message>
    <message>
        <source>Stopped.</source>
        <translation>Angehalten.</translation>
    </message>
    <message>
        <source>Go on with an &amp;interrupted run</source>
        <translation>Einen unte&amp;rbrochenen Lauf fortsetzen</translation>
    </message>
    <message>
        <source>As it was begun: the choices above are for a new run</source>
        <translation>So, wie er begonnen wurde: Die Auswahl oben gilt für einen neuen Lauf</translation>
    </message>
    <message>
        <source>The interrupted run in this folder is of another request: untick to replace it, or name another folder.</source>
        <translation>Der unterbrochene Lauf in diesem Ordner gehört zu einem anderen Auftrag: Haken fortnehmen, um ihn zu ersetzen, oder einen anderen Ordner nennen.</translation>
    </message>
    <message>
        <source>Options</source>
        <translation>Optionen</translation>
    </message>
    <message>
        <source>none</source>
        <translation>keine</translation>
    </message>
    <message>
        <source>For e&amp;xport</source>
        <translation>Für E&amp;xport</translation>
    </message>
    <message>
        <source>Adds the layers and options that this export needs</source>
        <translation>Fügt die Ebenen und Optionen hinzu, die dieser Export braucht</translation>
    </message>
</context>
<context>
    <name>dgtk::RenderOptions</name>
    <message>
        <source>File formats</source>
        <translation>Dateiformate</translation>
    </message>
</context>
<context>
    <name>dgtk::RenderProcess</name>
    <message>
        <source>%1 cannot be started: %2</source>
        <translation>%1 lässt sich nicht starten: %2</translation>
    </message>
    <message>
        <source>The progress of the run cannot be kept: %1</source>
        <translation>Der Fortschritt des Laufs kann nicht aufgehoben werden: %1</translation>
    </message>
</context>
<context>
    <name>dgtk::RenderStatus</name>
    <message>
        <source>Rendering ...</source>
        <translation>Wird berechnet ...</translation>
    </message>
    <message>
        <source>Rendering: %1 %</source>
        <translation>Berechnet: %1 %</translation>
    </message>
    <message>
        <source>Rendering: %1 %, %2 left</source>
        <translation>Berechnet: %1 %, noch %2</translation>
    </message>
    <message>
        <source>Click for the render configuration</source>
        <translation>Klicken, um die Berechnung zu sehen</translation>
    </message>
</context>
<context>
    <name>dgtk::RunFolder</name>
    <message>
        <source>An interrupted run stands in this folder%1. Start goes on with it.</source>
        <translation>In diesem Ordner steht ein unterbrochener Lauf%1. Start setzt ihn fort.</translation>
    </message>
    <message>
        <source> (%1 of %2 pictures)</source>
        <translation> (%1 von %2 Bildern)</translation>
    </message>
    <message>
        <source>A run into this folder goes on. Start shows it.</source>
        <translation>In diesen Ordner wird gerade berechnet. Start zeigt es.</translation>
    </message>
    <message>
        <source>Another program is rendering into this folder.</source>
        <translation>Ein anderes Programm rechnet in diesen Ordner.</translation>
    </message>
    <message>
        <source>%1 holds an interrupted run.</source>
        <translation>%1 enthält einen unterbrochenen Lauf.</translation>
    </message>
    <message>
        <source>%1 holds an interrupted run of another scene, or of this one before it was changed.</source>
        <translation>%1 enthält einen unterbrochenen Lauf einer anderen Szene oder von dieser, bevor sie geändert wurde.</translation>
    </message>
    <message>
        <source>%1 holds a finished dataset.</source>
        <translation>%1 enthält einen fertigen Datensatz.</translation>
    </message>
    <message>
        <source>Go on with it, or replace it by this run? What it has made so far goes then.</source>
        <translation>Ihn fortsetzen oder durch diesen Lauf ersetzen? Dann ist fort, was er bisher gemacht hat.</translation>
    </message>
    <message>
        <source>Go on</source>
        <translation>Fortsetzen</translation>
    </message>
    <message>
        <source>Replace</source>
        <translation>Ersetzen</translation>
    </message>
    <message>
        <source>Another folder</source>
        <translation>Anderer Ordner</translation>
    </message>
    <message>
        <source>Replace it by this run? Cancel to name another folder.</source>
        <translation>Soll dieser Lauf ihn ersetzen? Abbrechen, um einen anderen Ordner zu nennen.</translation>
    </message>
</context>
<context>
    <name>dgtk::SampleDialog</name>
    <message>
        <source>Sample a random scene</source>
        <translation>Zufällige Szene ziehen</translation>
    </message>
    <message>
        <source>The scene&apos;s own seed, or another one to draw with</source>
        <translation>Der Startwert der Szene, oder ein anderer, mit dem gezogen wird</translation>
    </message>
    <message>
        <source>&amp;Previous</source>
        <translation>&amp;Vorige</translation>
    </message>
    <message>
        <source>Ne&amp;xt</source>
        <translation>&amp;Nächste</translation>
    </message>
    <message>
        <source>Dr&amp;aw</source>
        <translation>Z&amp;iehen</translation>
    </message>
    <message>
        <source>Draw this sample of the file as it is now</source>
        <translation>Diese Ziehung aus der Datei, wie sie jetzt ist</translation>
    </message>
    <message>
        <source>Random scene</source>
        <translation>Zufällige Szene</translation>
    </message>
    <message>
        <source>Sample &amp;number</source>
        <translation>N&amp;ummer der Ziehung</translation>
    </message>
    <message>
        <source>&amp;Seed</source>
        <translation>&amp;Startwert</translation>
    </message>
    <message>
        <source>St&amp;op</source>
        <translation>An&amp;halten</translation>
    </message>
    <message>
        <source>Parameter or random value</source>
        <translation>Parameter oder zufälliger Wert</translation>
    </message>
    <message>
        <source>Drawn</source>
        <translation>Gezogen</translation>
    </message>
    <message>
        <source>Ru&amp;les: left out, refused, attempts, measured</source>
        <translation>Re&amp;geln: ausgelassen, abgelehnt, Versuche, gemessen</translation>
    </message>
    <message>
        <source>&amp;Keep as scene ...</source>
        <translation>Als S&amp;zene behalten ...</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Schließen</translation>
    </message>
    <message>
        <source>Drawing sample %1 ...</source>
        <translation>Ziehung %1 ...</translation>
    </message>
    <message>
        <source>Stopped. The views show sample %1.</source>
        <translation>Angehalten. Die Ansichten zeigen Ziehung %1.</translation>
    </message>
    <message>
        <source>Stopped.</source>
        <translation>Angehalten.</translation>
    </message>
    <message>
        <source>Sample %1 is refused: %2</source>
        <translation>Ziehung %1 ist abgelehnt: %2</translation>
    </message>
    <message>
        <source>attempts: %1</source>
        <translation>Versuche: %1</translation>
    </message>
    <message>
        <source>%1. The views show sample %2.</source>
        <translation>%1. Die Ansichten zeigen Ziehung %2.</translation>
    </message>
    <message>
        <source>Sample %1: %2; %3 left out</source>
        <translation>Ziehung %1: %2; %3 ausgelassen</translation>
    </message>
</context>
<context>
    <name>dgtk::SampleWriter</name>
    <message>
        <source>Write samples</source>
        <translation>Ziehungen schreiben</translation>
    </message>
    <message>
        <source>&amp;From</source>
        <translation>V&amp;on</translation>
    </message>
    <message>
        <source>&amp;to</source>
        <translation>&amp;bis</translation>
    </message>
    <message>
        <source>Fol&amp;der</source>
        <translation>O&amp;rdner</translation>
    </message>
    <message>
        <source>Browse ...</source>
        <translation>Durchsuchen ...</translation>
    </message>
    <message>
        <source>&amp;Replace other samples in this folder</source>
        <translation>Andere Ziehungen in diesem Ordner &amp;ersetzen</translation>
    </message>
    <message>
        <source>&amp;Write</source>
        <translation>S&amp;chreiben</translation>
    </message>
    <message>
        <source>&amp;Cancel</source>
        <translation>&amp;Abbrechen</translation>
    </message>
    <message>
        <source>Folder of the samples</source>
        <translation>Ordner der Ziehungen</translation>
    </message>
    <message>
        <source>Name the folder of the samples.</source>
        <translation>Nennen Sie den Ordner der Ziehungen.</translation>
    </message>
    <message>
        <source>The first number is greater than the last.</source>
        <translation>Die erste Nummer ist größer als die letzte.</translation>
    </message>
    <message>
        <source>Writing samples ...</source>
        <translation>Ziehungen werden geschrieben ...</translation>
    </message>
    <message>
        <source>; Replace removes them</source>
        <translation>; Ersetzen entfernt sie</translation>
    </message>
    <message>
        <source>Stopped.</source>
        <translation>Angehalten.</translation>
    </message>
</context>
<context>
    <name>dgtk::SceneFiles</name>
    <message>
        <source>DGTk</source>
        <translation>DGTk</translation>
    </message>
    <message>
        <source>Models that are not there: %1</source>
        <translation>Modelle, die nicht da sind: %1</translation>
    </message>
    <message>
        <source>%1

Grey boxes stand in their place. The scene can be edited and saved, but not rendered.</source>
        <translation>%1

Graue Kästen stehen an ihrer Stelle. Die Szene kann bearbeitet und gespeichert, aber nicht berechnet werden.</translation>
    </message>
    <message>
        <source>&amp;Find folder ...</source>
        <translation>&amp;Ordner suchen ...</translation>
    </message>
    <message>
        <source>Folder below which the models are</source>
        <translation>Ordner, unter dem die Modelle liegen</translation>
    </message>
    <message>
        <source>Looking for models in %1 ...</source>
        <translation>Suche Modelle in %1 ...</translation>
    </message>
    <message>
        <source>Found %1 of %2 models</source>
        <translation>%1 von %2 Modellen gefunden</translation>
    </message>
    <message>
        <source>The editor ended without saving a scene that had no name yet, at %1.</source>
        <translation>Der Editor endete, ohne eine Szene zu speichern, die noch keinen Namen hatte, am %1.</translation>
    </message>
    <message>
        <source>The editor ended without saving %1, at %2.</source>
        <translation>Der Editor endete, ohne %1 zu speichern, am %2.</translation>
    </message>
    <message>
        <source>Open what was kept of it, or discard it for good. Cancel asks again next time.</source>
        <translation>Öffnen, was davon aufgehoben wurde, oder endgültig verwerfen. Abbrechen fragt beim nächsten Mal wieder.</translation>
    </message>
    <message>
        <source>Reading what was kept ...</source>
        <translation>Aufgehobenes wird gelesen ...</translation>
    </message>
    <message>
        <source>Recovered: %1</source>
        <translation>Wiederhergestellt: %1</translation>
    </message>
    <message>
        <source>a scene without a name</source>
        <translation>eine Szene ohne Namen</translation>
    </message>
    <message>
        <source>There is other unsaved work, too (%1): the next start asks about it.</source>
        <translation>Es gibt noch andere nicht gespeicherte Arbeit (%1): der nächste Start fragt danach.</translation>
    </message>
    <message>
        <source>Another file is being read: wait for it, or cancel it.</source>
        <translation>Eine andere Datei wird gelesen: warten oder abbrechen.</translation>
    </message>
    <message>
        <source>Cancelled: %1</source>
        <translation>Abgebrochen: %1</translation>
    </message>
    <message>
        <source>Open a scene</source>
        <translation>Szene öffnen</translation>
    </message>
    <message>
        <source>Scenes (*.json *.scene);;All files (*)</source>
        <translation>Szenen (*.json *.scene);;Alle Dateien (*)</translation>
    </message>
    <message>
        <source>Reading %1 ...</source>
        <translation>%1 wird gelesen ...</translation>
    </message>
    <message>
        <source>All models (%1)</source>
        <translation>Alle Modelle (%1)</translation>
    </message>
    <message>
        <source>Import models</source>
        <translation>Modelle importieren</translation>
    </message>
    <message>
        <source>%1 has no surfaces: nothing was added.</source>
        <translation>%1 hat keine Flächen: nichts wurde hinzugefügt.</translation>
    </message>
    <message>
        <source>Imported %1</source>
        <translation>%1 importiert</translation>
    </message>
    <message>
        <source>Saved %1</source>
        <translation>%1 gespeichert</translation>
    </message>
    <message>
        <source>Save the scene</source>
        <translation>Szene speichern</translation>
    </message>
    <message>
        <source>Scene (*.json);;Thesis scene (*.scene)</source>
        <translation>Szene (*.json);;Szene der Diplomarbeit (*.scene)</translation>
    </message>
    <message>
        <source>The scene has changes that are not saved.</source>
        <translation>Die Szene hat Änderungen, die nicht gespeichert sind.</translation>
    </message>
    <message>
        <source>Save them, or they are lost.</source>
        <translation>Ungespeichert gehen sie verloren.</translation>
    </message>
    <message>
        <source>Export for POV-Ray</source>
        <translation>Für POV-Ray exportieren</translation>
    </message>
    <message>
        <source>POV-Ray scene (*.pov)</source>
        <translation>POV-Ray-Szene (*.pov)</translation>
    </message>
    <message>
        <source>Writing %1 ...</source>
        <translation>%1 wird geschrieben ...</translation>
    </message>
    <message>
        <source>Wrote %1</source>
        <translation>%1 geschrieben</translation>
    </message>
    <message>
        <source>Sample a random scene</source>
        <translation>Zufällige Szene ziehen</translation>
    </message>
    <message>
        <source>Random scenes (*.json);;All files (*)</source>
        <translation>Zufällige Szenen (*.json);;Alle Dateien (*)</translation>
    </message>
    <message>
        <source>%1 has random values.</source>
        <translation>%1 hat zufällige Werte.</translation>
    </message>
    <message>
        <source>Samples of it are plain scenes, which the window can show.</source>
        <translation>Ziehungen daraus sind einfache Szenen, die das Fenster zeigen kann.</translation>
    </message>
    <message>
        <source>&amp;Sample ...</source>
        <translation>&amp;Ziehen ...</translation>
    </message>
    <message>
        <source>Opened %1: %2</source>
        <translation>%1 geöffnet: %2</translation>
    </message>
    <message>
        <source>%1: the name of the file is not UTF-8: rename it</source>
        <translation>%1: der Name der Datei ist nicht UTF-8: benennen Sie sie um</translation>
    </message>
    <message>
        <source>%1 was changed by another program since it was opened or saved here.</source>
        <translation>%1 wurde von einem anderen Programm geändert, seit es hier geöffnet oder gespeichert wurde.</translation>
    </message>
    <message>
        <source>%1 has comments, which the editor does not keep.</source>
        <translation>%1 hat Kommentare, die der Editor nicht behält.</translation>
    </message>
    <message>
        <source>Overwrite it, or save the scene in another file?</source>
        <translation>Überschreiben, oder die Szene in einer anderen Datei speichern?</translation>
    </message>
    <message>
        <source>&amp;Overwrite</source>
        <translation>&amp;Überschreiben</translation>
    </message>
    <message>
        <source>Save &amp;as ...</source>
        <translation>Speichern &amp;unter ...</translation>
    </message>
    <message>
        <source>%1 has changes that are not saved.</source>
        <translation>%1 hat Änderungen, die nicht gespeichert sind.</translation>
    </message>
</context>
<context>
    <name>dgtk::SceneTree</name>
    <message>
        <source>Name</source>
        <translation>Name</translation>
    </message>
    <message>
        <source>Kind</source>
        <translation>Art</translation>
    </message>
    <message>
        <source>Objects</source>
        <translation>Objekte</translation>
    </message>
    <message>
        <source>Lights</source>
        <translation>Lichter</translation>
    </message>
    <message>
        <source>Cameras</source>
        <translation>Kameras</translation>
    </message>
    <message>
        <source>hidden</source>
        <translation>verborgen</translation>
    </message>
    <message>
        <source>missing</source>
        <translation>fehlt</translation>
    </message>
    <message>
        <source>Its model is not there: %1</source>
        <translation>Sein Modell ist nicht da: %1</translation>
    </message>
    <message>
        <source>%1, hidden</source>
        <translation>%1, verborgen</translation>
    </message>
</context>
<context>
    <name>dgtk::SceneViews</name>
    <message>
        <source>Front</source>
        <translation>Vorn</translation>
    </message>
    <message>
        <source>Top</source>
        <translation>Oben</translation>
    </message>
    <message>
        <source>Side</source>
        <translation>Seite</translation>
    </message>
    <message>
        <source>Perspective</source>
        <translation>Perspektive</translation>
    </message>
    <message>
        <source>%1 looks at its own place at this frame: move its look-at point</source>
        <translation>%1 blickt in diesem Bild auf den eigenen Ort: den Blickpunkt verschieben</translation>
    </message>
</context>
<context>
    <name>dgtk::TimeLine</name>
    <message>
        <source>Frame</source>
        <translation>Bild</translation>
    </message>
    <message>
        <source> frames/s</source>
        <translation> Bilder/s</translation>
    </message>
    <message>
        <source>The scene&apos;s frame rate: of playing, and of the models&apos; sequences</source>
        <translation>Bildrate der Szene: beim Abspielen und für die Sequenzen der Modelle</translation>
    </message>
    <message>
        <source>To the key frame before (Ctrl+Left)</source>
        <translation>Zum vorigen Schlüsselbild (Strg+Links)</translation>
    </message>
    <message>
        <source>Play from this frame (Space)</source>
        <translation>Ab diesem Bild abspielen (Leertaste)</translation>
    </message>
    <message>
        <source>To the next key frame (Ctrl+Right)</source>
        <translation>Zum nächsten Schlüsselbild (Strg+Rechts)</translation>
    </message>
    <message>
        <source>Begin again after the last frame</source>
        <translation>Nach dem letzten Bild von vorn beginnen</translation>
    </message>
    <message>
        <source>Make &amp;key frame</source>
        <translation>&amp;Schlüsselbild setzen</translation>
    </message>
    <message>
        <source>&amp;Remove key frame</source>
        <translation>S&amp;chlüsselbild entfernen</translation>
    </message>
</context>
<context>
    <name>dgtk::TimeLineCells</name>
    <message>
        <source>Drag: move the key. Ctrl: copy it. Right click: interpolation.</source>
        <translation>Ziehen: Schlüssel verschieben. Strg: kopieren. Rechtsklick: Interpolation.</translation>
    </message>
    <message>
        <source>Drag: move this key frame of the whole scene. Ctrl: copy it.</source>
        <translation>Ziehen: dieses Schlüsselbild der ganzen Szene verschieben. Strg: kopieren.</translation>
    </message>
    <message>
        <source>Drag: move the start of the sequence.</source>
        <translation>Ziehen: Anfang der Sequenz verschieben.</translation>
    </message>
    <message>
        <source>Drag: change the speed of the sequence.</source>
        <translation>Ziehen: Tempo der Sequenz ändern.</translation>
    </message>
    <message>
        <source>copy %1 to %2</source>
        <translation>%1 nach %2 kopieren</translation>
    </message>
    <message>
        <source>%1 to %2</source>
        <translation>%1 nach %2</translation>
    </message>
    <message>
        <source>Objects, lights and cameras get rows here. Right-click a frame to make a key frame.</source>
        <translation>Objekte, Lichter und Kameras bekommen hier Zeilen. Rechtsklick auf ein Bild setzt ein Schlüsselbild.</translation>
    </message>
    <message>
        <source>Make &amp;key frame at %1</source>
        <translation>&amp;Schlüsselbild bei %1 setzen</translation>
    </message>
    <message>
        <source>&amp;Remove key frame at %1</source>
        <translation>Schlüsselbild &amp;bei %1 entfernen</translation>
    </message>
    <message>
        <source>&amp;Copy key frame</source>
        <translation>Schlüsselbild &amp;kopieren</translation>
    </message>
    <message>
        <source>&amp;Paste key frame %1 here</source>
        <translation>Schlüsselbild %1 &amp;hier einfügen</translation>
    </message>
    <message>
        <source>&amp;Move key frame %1 here</source>
        <translation>Schlüsselbild %1 hierher &amp;verschieben</translation>
    </message>
</context>
<context>
    <name>dgtk::TimeLineEdits</name>
    <message>
        <source>Remove &amp;its keys at %1</source>
        <translation>Seine Schlüssel bei %1 &amp;entfernen</translation>
    </message>
    <message>
        <source>&amp;From its key at %1 to the next</source>
        <translation>Von seinem Schlüssel bei %1 &amp;zum nächsten</translation>
    </message>
    <message>
        <source>&amp;As its other keys</source>
        <translation>&amp;Wie seine anderen Schlüssel</translation>
    </message>
    <message>
        <source>&amp;Linear</source>
        <translation>&amp;Linear</translation>
    </message>
    <message>
        <source>&amp;Steps</source>
        <translation>S&amp;tufen</translation>
    </message>
    <message>
        <source>S&amp;mooth</source>
        <translation>&amp;Glatt</translation>
    </message>
    <message>
        <source>&amp;Between all its keys</source>
        <translation>Zwischen &amp;allen seinen Schlüsseln</translation>
    </message>
    <message>
        <source>&amp;Sequence</source>
        <translation>Se&amp;quenz</translation>
    </message>
    <message>
        <source>Be&amp;gin the sequence here</source>
        <translation>Seq&amp;uenz hier beginnen</translation>
    </message>
    <message>
        <source>The model&apos;s &amp;own speed</source>
        <translation>Eigenes Tempo &amp;des Modells</translation>
    </message>
    <message>
        <source>Repea&amp;t the sequence</source>
        <translation>Seque&amp;nz wiederholen</translation>
    </message>
</context>
<context>
    <name>dgtk::TruthPanel</name>
    <message>
        <source>What</source>
        <translation>Was</translation>
    </message>
    <message>
        <source>Value</source>
        <translation>Wert</translation>
    </message>
    <message>
        <source>Move the mouse over the perspective view.</source>
        <translation>Maus über die Perspektive bewegen.</translation>
    </message>
    <message>
        <source>View</source>
        <translation>Ansicht</translation>
    </message>
    <message>
        <source>%1, frame %2</source>
        <translation>%1, Bild %2</translation>
    </message>
    <message>
        <source>Pixel</source>
        <translation>Pixel</translation>
    </message>
    <message>
        <source>column %1, row %2</source>
        <translation>Spalte %1, Zeile %2</translation>
    </message>
    <message>
        <source>Unknown</source>
        <translation>Unbekannt</translation>
    </message>
    <message>
        <source>Object</source>
        <translation>Objekt</translation>
    </message>
    <message>
        <source>nothing</source>
        <translation>nichts</translation>
    </message>
    <message>
        <source>%1 (id %2)</source>
        <translation>%1 (Nr. %2)</translation>
    </message>
    <message>
        <source>Class</source>
        <translation>Klasse</translation>
    </message>
    <message>
        <source>Part</source>
        <translation>Teil</translation>
    </message>
    <message>
        <source>unnamed</source>
        <translation>ohne Namen</translation>
    </message>
    <message>
        <source>Triangle</source>
        <translation>Dreieck</translation>
    </message>
    <message>
        <source>  %1: %2</source>
        <translation>  %1: %2</translation>
    </message>
    <message>
        <source>distance %1
part %2, triangle %3</source>
        <translation>Entfernung %1
Teil %2, Dreieck %3</translation>
    </message>
    <message>
        <source>depth %1
part %2, triangle %3</source>
        <translation>Tiefe %1
Teil %2, Dreieck %3</translation>
    </message>
    <message>
        <source>id %1, coverage %2 / 255</source>
        <translation>Nr. %1, Bedeckung %2 / 255</translation>
    </message>
    <message>
        <source>Surfaces</source>
        <translation>Flächen</translation>
    </message>
    <message>
        <source>Picture</source>
        <translation>Bild</translation>
    </message>
</context>
<context>
    <name>dgtk::TruthView</name>
    <message>
        <source>What the perspective view shows</source>
        <translation>Was die perspektivische Ansicht zeigt</translation>
    </message>
    <message>
        <source>Colour</source>
        <translation>Farbe</translation>
    </message>
    <message>
        <source>through camera %1</source>
        <translation>durch Kamera %1</translation>
    </message>
    <message>
        <source>Perspective</source>
        <translation>Perspektive</translation>
    </message>
    <message>
        <source>(%1, %2)</source>
        <translation>(%1, %2)</translation>
    </message>
    <message>
        <source>%1: %2 (bright) to %3 (dark)</source>
        <translation>%1: %2 (hell) bis %3 (dunkel)</translation>
    </message>
    <message>
        <source>%1: full colour at %2 pixels</source>
        <translation>%1: volle Farbe bei %2 Pixeln</translation>
    </message>
    <message>
        <source>the picture, one sample a pixel</source>
        <translation>das Bild, ein Abtastpunkt je Pixel</translation>
    </message>
    <message>
        <source>all is out of the range of the depth sensor</source>
        <translation>alles außerhalb der Reichweite des Tiefensensors</translation>
    </message>
    <message>
        <source>nothing is seen</source>
        <translation>es ist nichts zu sehen</translation>
    </message>
</context>
<context>
    <name>dgtk::SceneClipboard</name>
    <message>
        <source>The clipboard has no part of a scene</source>
        <translation>Die Zwischenablage enthält keinen Teil einer Szene</translation>
    </message>
</context>
</TS>
