  // ---- Words of the languages that readers ask in: those that carry no meaning, and what is left of a word without its ending.

  // Words by which a question is a sentence; `on`, `off` and `not` are not among them.
  const STOP_WORDS = [
    "a adjust an and any are as at be been but by can carries carry change check configure contain containing contains could did do does find for from",
    "get give go goes had happen happened happens has have how i if in into is it its me mean means much must my need of one or our read see set should",
    "show so some tell than that the their them then there these they this those to too up use want was we were what when where which who why will with",
    "would you your",
    "aber ablesen als am auch auf aus auslesen bei beim bin bis da damit das dass dem den der des die dies diese diesem diesen dieser dieses du durch ein",
    "eine einem einen einer eines einstellen enthalten enthält er es für geht gibt hat haben heißt ich ihr im ins ist kann kannst konfigurieren können",
    "lesen man mein mich mir mit muss müssen nach noch nur ob oder passiert prüfen sehen sein sich sie sind soll sollte steht stehen über um und uns vom",
    "von vor wann warum welche welchem welchen welcher welches wenn wer werden wie wird wo wofür woher womit wozu zu zum zur",
  ].join(" ").split(" ");

  // Endings, each with what has to stay in front of it, in the order in which they are taken away.
  const ENDINGS = [
    /(?<=...)(?<![isu])s$|(?<=...e[lr])n$/, /(?<=....)(?:en|em|et|e)$|(?<=...)e$/, /(?<=....[mrsz])t$/, /(?<=.....)ung$/, /(?<=....)(?:ing|ed|er)$/,
    /(?<=..([bdfgklmnprt]))\1$/,
  ];
  // What words have in common that differ only in number, case or tense: `limits` and `limit`, `stored` and `store`, `Fehler` and `Fehlern`.
  const stem = (word) => {
    if (word.length < 4 || !/^\p{L}+$/u.test(word)) return word;
    return ENDINGS.reduce((left, ending) => left.replace(ending, ""), word).replace(/y$/, "i");
  };
