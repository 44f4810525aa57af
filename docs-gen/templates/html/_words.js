  // ---- Words of the languages that readers ask in: those that carry no meaning, and what is left of a word without its ending.

  // Words by which a question is a sentence; `on`, `off` and `not` are not among them.
  const STOP_WORDS = [
    "a about adjust again also an and any are as at be been but by can carries carry change check configure contain containing contains could did do",
    "does each every find for from get give go goes had happen happened happens has have how i if in into is it its just like make may me mean means much",
    "must my need of one only or other our out please read see send set should show so some still such tell than that the their them then there these they",
    "thing this those to too up use want was we were what when where which while who why will with work works would you your",
    "aber ablesen alle als am ändere ändern auch auf aus auslesen bei beim bin bis bitte brauche brauchen da damit dann das dass dem den der des die dies",
    "diese diesem diesen dieser dieses doch du durch ein eine einem einen einer eines einstellen enthält enthalten er es etwas finde finden für geht gibt",
    "haben hat heißt hier ich ihr im immer ins ist jede jeden jeder kann kannst konfigurieren können lassen lässt lese lesen liegt machen macht mal man",
    "mehr mein mich mir mit möchte muss müssen nach noch nur ob oder passiert prüfen schon sehen sehr sein sich sie sind soll sollte stehen steht stelle",
    "tun über um und uns vom von vor wann warum welche welchem welchen welcher welches wenn wer werden wie wieder wir wird wo wofür woher wollen womit wozu",
    "zeigen zeigt zu zum zur",
  ].join(" ").split(" ");

  // Endings, each with what has to stay in front of it, in the order in which they are taken away.
  const ENDINGS = [
    /(?<=...)(?<![isu])s$|(?<=...e[lr])n$/, /(?<=....)(?:en|em|et|e)$|(?<=...)e$/, /(?<=.....)ung$/, /(?<=....[mrsz])t$/, /(?<=....)(?:(?:er)?(?:ing|ed)|er)$/,
    /(?<=..([bdfgklmnprt]))\1$/,
  ];
  // What words have in common that differ only in number, case or tense: `limits` and `limit`, `stored` and `store`, `Fehler` and `Fehlern`.
  const stem = (word) => {
    if (word.length < 4 || !/^\p{L}+$/u.test(word)) return word;
    return ENDINGS.reduce((left, ending) => left.replace(ending, ""), word).replace(/y$/, "i");
  };
